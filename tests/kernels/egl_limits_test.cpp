// SPDX-License-Identifier: Apache-2.0
// Problems beyond what a device's buffers hold.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <span>
#include <vector>

#include "egl.hpp"
#include "glint/kernels/all.hpp"
#include "glint/kernels/core/gl_context.hpp"
#include "glint/kernels/core/gl_queue.hpp"
#include "glint/kernels/core/resident_memory.hpp"
#include "glint/kernels/parity.hpp"
#include "glint/kernels/resample/resample.hpp"

namespace glint {
namespace {

Device with_limit(std::size_t bytes) {
  Device device = Device::egl();
  device.context().run([&](gl::Queue& queue) {
    queue.limit(bytes);
    queue.set_keeping(gl::Queue::Keeping::spoiling);
  });
  return device;
}

// The two kernels that need all particles at once go to the processor; trials of more particles
// than fit are among those that parity_test.cpp runs.
TEST(EglLimits, KernelsThatCannotBeCutStayInsideTheirTolerance) {
  GLINT_NEEDS_EGL(unused);
  const std::vector<Device> small{with_limit(std::size_t{60} << 10)};
  for (const char* name : {"resample", "cell_weights"}) {
    const auto kernel = std::ranges::find(all_kernels(), name, &KernelEntry::name);
    for (const ParityRow& row : check_parity(*kernel, small)) EXPECT_TRUE(row.ok()) << row.kernel;
  }
}

TEST(EglLimits, WhatIsKeptIsFetchedForTheProcessorAndSentBack) {
  GLINT_NEEDS_EGL(unused);
  const Device device = with_limit(4096);
  constexpr std::size_t kCount = 5000;
  ResidentArray<float> weights(device), from(device), to(device);
  ResidentArray<std::uint32_t> ancestors(device);
  for (auto* array : {&weights, &from, &to}) array->resize(kCount);
  ancestors.resize(kCount);
  for (std::size_t i = 0; i < kCount; ++i) weights.values()[i] = i == 77 ? 1 : 0;
  std::iota(from.values().begin(), from.values().end(), 0.0F);
  weights.send(), from.send();
  std::ranges::fill(from.values(), -1.0F);  // the device's count
  const MovedArray moved{from.values().data(), to.values().data()};
  device.run<Resample>({.weights = weights.values(),
                        .ancestors = ancestors.values(),
                        .moved = std::span(&moved, 1)});
  std::ranges::fill(to.values(), -1.0F);
  to.fetch(), ancestors.fetch();
  for (std::size_t i = 0; i < kCount; ++i) {
    ASSERT_EQ(ancestors.values()[i], 77U);
    ASSERT_EQ(to.values()[i], 77);
  }
}

}  // namespace
}  // namespace glint

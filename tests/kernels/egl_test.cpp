// SPDX-License-Identifier: Apache-2.0
#include "egl.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "glint/kernels/core/gl_context.hpp"
#include "glint/kernels/core/gl_queue.hpp"

namespace glint {
namespace {

constexpr gl::Shader kTwice{"twice", R"(#version 430 core
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Parameters { uint count; };
layout(std430, binding = 1) buffer Values { uint values[]; };
void twice() {
  uint i = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 64u + gl_GlobalInvocationID.x;
  if (i < count) values[i] *= 2u;
}
)"};
constexpr gl::Shader kBroken{"broken", "#version 430 core\nvoid pass() { float x = y; }\n"};

std::vector<std::uint32_t> numbers(std::size_t n) {
  std::vector<std::uint32_t> values(n);
  std::iota(values.begin(), values.end(), 0);
  return values;
}

/// `values`, doubled on the device.
std::vector<std::uint32_t> doubled(gl::Queue& queue, const std::vector<std::uint32_t>& values) {
  const gl::Buffer there = queue.upload(std::span(values));
  queue.run(kTwice, "twice", values.size(), static_cast<std::uint32_t>(values.size()), {&there});
  std::vector<std::uint32_t> back(values.size());
  queue.read(there, std::span(back));
  return back;
}

std::string message_of_broken(const Device& device) {
  try {
    device.context().run([](gl::Queue& queue) {
      const gl::Buffer none = queue.buffer<float>(1);
      queue.run(kBroken, "pass", 1, 1u, {&none});
    });
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "nothing was thrown";
}

TEST(Egl, RunsEveryItemOnce) {
  GLINT_NEEDS_EGL(device);
  for (const std::size_t n : {0u, 1u, 63u, 64u, 65u, 100000u, 5000000u}) {
    const auto values = numbers(n);
    std::vector<std::uint32_t> got;
    device.context().run([&](gl::Queue& queue) { got = doubled(queue, values); });
    ASSERT_EQ(got.size(), n);
    for (std::size_t i = 0; i < n; ++i) ASSERT_EQ(got[i], 2 * i) << n;
  }
}

TEST(Egl, ServesManyThreads) {
  GLINT_NEEDS_EGL(device);
  std::array<bool, 8> right{};
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < right.size(); ++t) {
    threads.emplace_back([&, t] {
      for (std::size_t n = 100 * t; n < 100 * t + 20; ++n) {
        std::vector<std::uint32_t> got;
        device.context().run([&](gl::Queue& queue) { got = doubled(queue, numbers(n)); });
        right.at(t) = got.size() == n && (n == 0 || got.back() == 2 * (n - 1));
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const bool r : right) EXPECT_TRUE(r);
}

TEST(Egl, NamesDeviceShaderAndRemedyForAShaderThatDoesNotCompile) {
  GLINT_NEEDS_EGL(device);
  const std::string message = message_of_broken(device);
  EXPECT_NE(message.find("egl:" + std::to_string(device.context().device().number)),
            std::string::npos);
  EXPECT_NE(message.find("broken.pass does not compile"), std::string::npos) << message;
  EXPECT_NE(message.find("--device tbb"), std::string::npos) << message;
}

TEST(Egl, WorksOnAfterAnError) {
  GLINT_NEEDS_EGL(device);
  message_of_broken(device);
  std::vector<std::uint32_t> got;
  device.context().run([&](gl::Queue& queue) { got = doubled(queue, numbers(3)); });
  EXPECT_EQ(got, (std::vector<std::uint32_t>{0, 2, 4}));
}

TEST(Egl, RefusesABufferBeyondTheLimitWithTheRemedy) {
  GLINT_NEEDS_EGL(device);
  device.context().run([](gl::Queue& queue) { queue.limit(4096); });
  try {
    device.context().run([](gl::Queue& queue) { queue.buffer<float>(1025); });
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("--device tbb"), std::string::npos) << e.what();
  }
  device.context().run([](gl::Queue& queue) { queue.buffer<float>(1024); });
}

TEST(Egl, ListsWhatItOpens) {
  GLINT_NEEDS_EGL(device);
  const EglDevices all = egl_devices();
  ASSERT_FALSE(all.devices.empty());
  EXPECT_TRUE(all.missing.empty());
  for (std::size_t i = 0; i < all.devices.size(); ++i) {
    EXPECT_EQ(all.devices[i].number, static_cast<int>(i));
    EXPECT_FALSE(all.devices[i].renderer.empty());
    const Device opened = Device::named("egl:" + std::to_string(i));
    EXPECT_EQ(opened.kind(), DeviceKind::egl);
    EXPECT_EQ(opened.description(), description(all.devices[i]));
  }
}

TEST(Egl, PrefersHardware) {
  GLINT_NEEDS_EGL(device);
  const EglDevices all = egl_devices();
  const bool only_software = std::ranges::all_of(all.devices, &EglDevice::software);
  EXPECT_EQ(device.context().device().software, only_software);
}

TEST(Egl, ListsTheDevicesForANumberThatIsNotThere) {
  GLINT_NEEDS_EGL(device);
  try {
    Device::named("egl:99");
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_TRUE(
        std::string(e.what()).starts_with("device egl:99 is not here; this machine has egl:0"))
        << e.what();
  }
}

TEST(Egl, IsNamedWithAWholeNumberOnly) {
  for (const char* name : {"egl:", "egl:x", "egl:-1", "egl:1x", "EGL"}) {
    EXPECT_THROW(Device::named(name), std::invalid_argument) << name;
  }
}

TEST(EglDevice, IsDescribedInOneLine) {
  EXPECT_EQ(description(EglDevice{1, "Maker", "Card", "4.6 D", 8ull << 30, false}),
            "egl:1 (Card, Maker, OpenGL 4.6 D, 8192 MB, hardware)");
  EXPECT_EQ(description(EglDevice{0, "Mesa", "llvmpipe", "4.5", 0, true}),
            "egl:0 (llvmpipe, Mesa, OpenGL 4.5, software)");
}

}  // namespace
}  // namespace glint

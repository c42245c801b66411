// SPDX-License-Identifier: Apache-2.0
#include "egl.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "glint/bench/bench.hpp"
#include "glint/bench/kernels/suites.hpp"

namespace glint::bench {
namespace {

double figure(const Result& result, const std::string& name) {
  const auto found = std::ranges::find(result.figures, name, &Figure::name);
  if (found != result.figures.end()) return found->value;
  ADD_FAILURE() << "no figure " << name;
  return 0;
}

double seconds(const Result& result, const std::string& name) {
  const auto found = std::ranges::find(result.timings, name, &Timing::name);
  if (found != result.timings.end()) return found->seconds;
  ADD_FAILURE() << "no case " << name;
  return 0;
}

TEST(BenchEgl, FramesTellWhatTheTimeGoesToAndWhatTravels) {
  GLINT_NEEDS_EGL(device);
  Options options{{256, 256}, true};
  options.egl = device;
  const Result result = bench_egl_frames(options);
  double shares = 0;
  for (const char* name : {"upload", "kernels", "read-back", "the processor"}) {
    const double share = figure(result, std::string("share of ") + name);
    EXPECT_GT(share, 0) << name;
    EXPECT_LT(share, 1) << name;
    shares += share;
  }
  EXPECT_NEAR(shares, 1, 1e-9);
  EXPECT_GT(seconds(result, "frame"), 0);
  EXPECT_GE(figure(result, "MB sent a frame"), 256 * 256 * 2 / 1e6);  // the raw frame
  EXPECT_GT(figure(result, "MB read back a frame"), 0);
  EXPECT_GT(figure(result, "particles after the last frame"), 1000);
}

TEST(BenchEgl, KernelsStandBesideTheDevicesCopyAndTbb) {
  GLINT_NEEDS_EGL(device);
  const Result result = egl_bandwidth(device, {256, 256}, true);
  EXPECT_GT(seconds(result, "copy on the device"), 0);
  for (const char* kernel : {"pixel_likelihood", "particle_likelihood", "propagate"}) {
    EXPECT_GT(figure(result, std::string(kernel) + ": shaders of the copy"), 0);
    EXPECT_GT(figure(result, std::string(kernel) + ": shaders of tbb"), 0);
    EXPECT_GT(seconds(result, std::string(kernel) + ": with both ways"),
              seconds(result, std::string(kernel) + ": shaders"));
  }
}

}  // namespace
}  // namespace glint::bench

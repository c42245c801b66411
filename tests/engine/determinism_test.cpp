// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "egl.hpp"
#include "glint/engine/scenario/scenes.hpp"
#include "glint/experiments/log_parity.hpp"
#include "glint/kernels/core/gl_context.hpp"
#include "glint/kernels/core/gl_queue.hpp"

namespace glint {
namespace {

/// 1, 2, 3 and 8 threads, then every instruction set on two.
std::vector<Device> devices() {
  std::vector<Device> list;
  for (const int threads : {1, 2, 3, 8}) list.push_back(Device::tbb(threads));
  for (const Isa isa : runnable_isas()) list.push_back(Device::tbb(2, isa));
  return list;
}

class Determinism : public testing::TestWithParam<TrackerEntry> {
 protected:
  void expect_one_log(const Scene& scene, std::span<const Device> all) {
    for (const LogParityRow& row : check_log_parity(GetParam(), scene, 3, all)) {
      EXPECT_TRUE(row.ok()) << row.scene << " on " << row.device << ": " << row.points
                            << " points, first different line: " << row.first_other_line;
    }
  }
  tbb::global_control eight_{tbb::global_control::max_allowed_parallelism, 8};
};

std::string test_name(const testing::TestParamInfo<TrackerEntry>& info) {
  std::string name(info.param.name);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(Trackers, Determinism,
                         testing::ValuesIn(all_trackers().begin(), all_trackers().end()),
                         test_name);

TEST_P(Determinism, LogOfManyTilesIsTheSameForAnyThreadsAndInstructionSet) {
  IrClipScene clip;
  clip.frames = 20;
  expect_one_log(make_scene(clip), devices());
}

TEST_P(Determinism, LogOfASmallFrameIsTheSameForAnyThreadsAndInstructionSet) {
  expect_one_log(make_scene(CrossingScene{}), devices());
}

TEST_P(Determinism, SerialDeviceRepeatsItself) {
  expect_one_log(make_scene(CrossingScene{}), std::vector{Device::serial(), Device::serial()});
}

/// A context of its own on the same device.
Device keeping(const Device& device, gl::Queue::Keeping how) {
  Device other = Device::egl(device.context().device().number);
  other.context().run([&](gl::Queue& queue) { queue.set_keeping(how); });
  return other;
}

// Nor does it matter what stays on the device between kernels: where the host's copies of that are
// spoilt, nothing can have read one that is out of date.
TEST_P(Determinism, EglDeviceRepeatsItselfWhateverItKeeps) {
  GLINT_NEEDS_EGL(device);
  expect_one_log(make_scene(CrossingScene{}),
                 std::vector{keeping(device, gl::Queue::Keeping::never),
                             keeping(device, gl::Queue::Keeping::spoiling)});
}

// The frames are the same: whatever differs comes from the tracker's own random numbers.
TEST_P(Determinism, TheSeedMattersToThoseThatDrawRandomNumbers) {
  static constexpr std::array<std::string_view, 9> kDrawNone{
      "h-pmht",   "imm-pda-ai", "viterbi",     "imm-jpda",       "imm-mscan-jpda",
      "pmht-imm", "pmht-ca",    "pmht-singer", "pmht-homothetic"};
  const Device device = Device::tbb(2);
  const auto log = [&](std::uint64_t seed) {
    FramesConfig frames;
    frames.background = BackgroundKind::none;
    Scheduler scheduler(device, FramePreparer(frames, device));
    scheduler.add(GetParam().make(GetParam().config(), device, seed));
    SceneSource source(make_scene(CrossingScene{}), 3);
    scheduler.run(source);
    return scheduler.logs().front()->text();
  };
  EXPECT_EQ(log(3), log(3));
  EXPECT_EQ(log(3) == log(4), std::ranges::find(kDrawNone, GetParam().name) != kDrawNone.end());
}

TEST(LogParity, NamesTheFirstOtherLine) {
  EXPECT_EQ(first_other_line("a\nb\n", "a\nb\n"), 0u);
  EXPECT_EQ(first_other_line("a\nb\n", "a\nc\n"), 2u);
  EXPECT_EQ(first_other_line("a\nb\n", "a\nb\nc\n"), 3u);
  EXPECT_EQ(first_other_line("", "a\n"), 1u);
}

TEST(LogParity, AnEmptyLogFails) { EXPECT_FALSE(LogParityRow{}.ok()); }

}  // namespace
}  // namespace glint

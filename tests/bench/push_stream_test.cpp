// SPDX-License-Identifier: Apache-2.0
// Ten minutes of frames that a camera pushes, on a clock that does not wait for them. An executable
// of its own: it counts every operator new.
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "counted_allocations.hpp"
#include "glint/bench/memory_source.hpp"
#include "glint/engine/engine.hpp"
#include "glint/engine/trackers/registry.hpp"

namespace glint {
namespace {

constexpr int kWidth = 640, kHeight = 512;
constexpr double kRate = 100;  // [frames/s]
constexpr std::int64_t kMinute = static_cast<std::int64_t>(60 * kRate), kFrames = 10 * kMinute;
constexpr int kKeep = 500;         // [frames]
constexpr double kFlat = 1 << 20;  // [bytes]; a frame has 655 360

std::unique_ptr<Engine> engine(EngineSettings::WhenFull when_full) {
  const Device device = Device::tbb();
  Scheduler scheduler(device, FramePreparer(FramesConfig{}, device));
  const TrackerEntry& entry = find_tracker("h-pmht");  // keeps up with far more than 100 frames/s
  scheduler.add(entry.make(entry.config(), device, 1), std::string(entry.name));
  scheduler.keep(kKeep);
  EngineSettings settings;
  settings.when_full = when_full;
  return std::make_unique<Engine>(std::move(scheduler), settings);
}

SourceFrame frame_of(const bench::MemoryScene& scene, std::int64_t index) {
  const auto view = scene.frame(index).view();
  SourceFrame frame;
  frame.pixels = {view.data, view.width, view.height, 1, view.pitch};
  frame.time = static_cast<double>(index) / kRate;
  return frame;
}

/// What came out so far.
struct Taken {
  void take(Engine& engine) {
    while (const auto result = engine.poll()) {
      EXPECT_GT(result->frame, last);
      EXPECT_EQ(result->time, static_cast<double>(result->frame) / kRate);
      last = result->frame;
      ++frames;
      points += static_cast<std::int64_t>(result->tracks.size());
    }
  }
  std::int64_t frames = 0, points = 0, last = -1;
};

double live() { return static_cast<double>(test::live_bytes); }

class PushStream : public testing::Test {
 protected:
  bench::MemoryScene scene_{kWidth, kHeight, {16, 4, 5, 14}};
};

TEST_F(PushStream, TenMinutesWithBackPressureLoseNoFrameAndKeepNoMemory) {
  const auto pushed = engine(EngineSettings::WhenFull::wait);
  Taken taken;
  double after_a_minute = 0;
  for (std::int64_t f = 0; f < kFrames; ++f) {
    ASSERT_TRUE(pushed->push(frame_of(scene_, f)));
    taken.take(*pushed);
    if ((f + 1) % kMinute != 0) continue;
    pushed->drain();
    taken.take(*pushed);
    EXPECT_EQ(taken.frames, f + 1);
    if (after_a_minute == 0) after_a_minute = live();
    EXPECT_LT(live(), after_a_minute + kFlat) << "after frame " << f;
  }
  pushed->finish();
  taken.take(*pushed);
  EXPECT_EQ(taken.frames, kFrames);
  EXPECT_EQ(pushed->pushed(), kFrames);
  EXPECT_EQ(pushed->dropped(), 0);
  EXPECT_GT(taken.points, kFrames);  // five targets
}

TEST_F(PushStream, TenMinutesThatDropCountWhatTheyDrop) {
  const auto pushed = engine(EngineSettings::WhenFull::drop_oldest);
  Taken taken;
  std::int64_t refused = 0;
  for (std::int64_t f = 0; f < kFrames; ++f) {
    refused += pushed->push(frame_of(scene_, f)) ? 0 : 1;
    taken.take(*pushed);
    if (f == kMinute) pushed->drain();
  }
  pushed->finish();
  taken.take(*pushed);
  EXPECT_EQ(pushed->pushed(), kFrames);
  EXPECT_EQ(pushed->dropped(), refused);
  EXPECT_EQ(taken.frames + pushed->dropped(), kFrames);
  EXPECT_GT(pushed->dropped(), 0);
  EXPECT_EQ(taken.last, kFrames - 1);
}

}  // namespace
}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/scheduler.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>
#include <thread>

#include "scheduler_fakes.hpp"

namespace glint::test {
namespace {

using SchedulerFailure = SchedulerTest;
INSTANTIATE_TEST_SUITE_P(Threads, SchedulerFailure, ::testing::Values(0, 1, 2, 3, 8));

TEST_P(SchedulerFailure, SourceFailureComesOutAfterAllEarlierFrames) {
  FakeSource source(kNever, throws_at(9, "clip.mp4: truncated"));
  scheduler.add(std::make_unique<FakeTracker>(1));
  scheduler.add(sink);
  EXPECT_EQ(error_of(scheduler, source), "clip.mp4: truncated");
  EXPECT_EQ(sink.frames, first(9));
  EXPECT_EQ(scheduler.frames(), 9);
  EXPECT_EQ(scheduler.logs().at(0)->online().size(), 9u);
}

TEST_P(SchedulerFailure, SourceFailureComesOutAfterTheFramesHeldForTheBackground) {
  FakeSource source(kNever, throws_at(9, "clip.mp4: truncated"));
  scheduler.prime(20);
  scheduler.add(std::make_unique<FakeTracker>(1));
  scheduler.add(sink);
  EXPECT_EQ(error_of(scheduler, source), "clip.mp4: truncated");
  EXPECT_EQ(sink.frames, first(9));
}

TEST_P(SchedulerFailure, PreparerFailureComesOutAfterAllEarlierFrames) {
  struct Growing : FakeSource {
    using FakeSource::FakeSource;
    std::optional<SourceFrame> next() override {
      auto frame = FakeSource::next();
      if (frame && read > 6) frame->pixels.height = 11;
      return frame;
    }
  } source(kNever);
  scheduler.add(sink);
  EXPECT_THROW(scheduler.run(source), std::invalid_argument);
  EXPECT_EQ(sink.frames, first(6));
}

TEST_P(SchedulerFailure, TrackerFailureComesOutAfterAllEarlierFrames) {
  FakeSource source(kNever);
  scheduler.add(std::make_unique<FakeTracker>(1));
  scheduler.add(std::make_unique<FakeTracker>(1, throws_at(7, "tracker")));
  scheduler.add(std::make_unique<FakeTracker>(1));
  scheduler.add(sink);
  EXPECT_EQ(error_of(scheduler, source), "tracker");
  EXPECT_EQ(sink.frames, first(7));
  EXPECT_EQ(scheduler.logs().at(1)->online().size(), 7u);
  EXPECT_EQ(scheduler.logs().at(2)->online().size(), 7u);
  EXPECT_EQ(scheduler.logs().at(2)->revised().at(0).status, TrackStatus::confirmed);
  EXPECT_EQ(scheduler.logs().at(1)->revised().at(0).status, TrackStatus::tentative);
}

TEST_P(SchedulerFailure, SinkFailureStopsTheRun) {
  FakeSource source(kNever);
  FakeSink before, failing(throws_at(5, "disk full"));
  scheduler.add(before);
  scheduler.add(failing);
  EXPECT_EQ(error_of(scheduler, source), "disk full");
  EXPECT_EQ(before.frames, first(6));
  EXPECT_EQ(failing.frames, first(5));
  EXPECT_LE(source.read, 5 + static_cast<std::int64_t>(Scheduler::kFramesInFlight));
}

// The slow second tracker fails at frame 4 after the first one failed at frame 5.
TEST_P(SchedulerFailure, FailureOfTheEarliestFrameIsTheOneThatComesOut) {
  FakeSource source(kNever);
  scheduler.add(std::make_unique<FakeTracker>(1, throws_at(5, "later")));
  scheduler.add(std::make_unique<FakeTracker>(1, [](std::int64_t frame) {
    if (frame != 4) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    throw std::runtime_error("earlier");
  }));
  scheduler.add(sink);
  EXPECT_EQ(error_of(scheduler, source), "earlier");
  EXPECT_EQ(sink.frames, first(4));
}

TEST_P(SchedulerFailure, FinishFailureComesOutAfterAllFrames) {
  struct Failing : FakeTracker {
    using FakeTracker::FakeTracker;
    void finish(TrackLog&) override { throw std::runtime_error("batch"); }
  };
  FakeSource source(5);
  scheduler.add(std::make_unique<Failing>(1));
  scheduler.add(std::make_unique<FakeTracker>(1));
  scheduler.add(sink);
  EXPECT_EQ(error_of(scheduler, source), "batch");
  EXPECT_EQ(sink.frames, first(5));
  EXPECT_EQ(scheduler.logs().at(1)->revised().at(0).status, TrackStatus::confirmed);
}

}  // namespace
}  // namespace glint::test

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/scheduler.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "scheduler_fakes.hpp"

namespace glint::test {
namespace {

INSTANTIATE_TEST_SUITE_P(Threads, SchedulerTest, ::testing::Values(0, 1, 2, 3, 8));

TEST_P(SchedulerTest, DeliversEveryFrameInOrder) {
  FakeSource source(50);
  scheduler.add(std::make_unique<FakeTracker>(2), "first");
  scheduler.add(std::make_unique<FakeTracker>(3), "second");
  scheduler.add(sink);
  EXPECT_EQ(scheduler.run(source), 50);
  EXPECT_EQ(sink.frames, first(50));
  ASSERT_EQ(sink.counts.size(), 100u);
  for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(sink.counts[i], i % 2 == 0 ? 2u : 3u);
}

TEST_P(SchedulerTest, ZeroFramesIsARunToo) {
  FakeSource source(0);
  scheduler.add(std::make_unique<FakeTracker>(1));
  scheduler.add(sink);
  EXPECT_EQ(scheduler.run(source), 0);
  EXPECT_TRUE(sink.frames.empty());
  EXPECT_TRUE(scheduler.logs().at(0)->online().empty());
}

TEST_P(SchedulerTest, TrackersSideBySideSayWhatTheySayAlone) {
  FakeSource source(30);
  std::vector<std::string> alone;
  for (std::int64_t tracks : {1, 4, 2}) {
    Scheduler single = scheduler_on(Device::serial());
    FakeSource again(30);
    single.add(std::make_unique<FakeTracker>(tracks));
    single.run(again);
    alone.push_back(single.logs().at(0)->text());
    scheduler.add(std::make_unique<FakeTracker>(tracks));
  }
  scheduler.run(source);
  ASSERT_EQ(scheduler.logs().size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(scheduler.logs()[i]->text(), alone[i]) << i;
}

TEST_P(SchedulerTest, StopFinishesWhatWasRead) {
  std::stop_source stop;
  FakeSource source(kNever, [&](std::int64_t frame) {
    if (frame == 11) stop.request_stop();
  });
  scheduler.add(std::make_unique<FakeTracker>(1));
  scheduler.add(sink);
  EXPECT_EQ(scheduler.run(source, stop.get_token()), 12);
  EXPECT_EQ(sink.frames, first(12));
  EXPECT_EQ(scheduler.logs().at(0)->revised().at(0).status, TrackStatus::confirmed);
}

TEST_P(SchedulerTest, HoldsABoundedNumberOfFrames) {
  FakeSource source(40);
  std::int64_t most = 0;
  FakeSink slow([&](std::int64_t frame) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    most = std::max(most, source.read - frame);
  });
  scheduler.add(slow);
  scheduler.run(source);
  EXPECT_GE(most, 1);
  EXPECT_LE(most, static_cast<std::int64_t>(Scheduler::kFramesInFlight));
}

TEST_P(SchedulerTest, KernelsInsideTrackersRunOnTheSameThreads) {
  struct Summing : FakeTracker {
    Summing(Workers& w) : FakeTracker(1), workers(w) {}
    void step(const Scan& scan, TrackLog& log) override {
      std::array<double, 64> parts{};
      workers.for_tiles(parts.size(), [&](std::size_t t) { parts[t] = double(t) + scan.time; });
      TrackPoint p;
      p.frame = scan.frame;
      p.x = 0;
      for (const double part : parts) p.x += part;
      log.report(p);
    }
    Workers& workers;
  };
  FakeSource source(20);
  for (int i = 0; i < 3; ++i) scheduler.add(std::make_unique<Summing>(device.workers()));
  scheduler.run(source);
  for (const TrackLog* log : scheduler.logs()) {
    const auto points = log->online();
    ASSERT_EQ(points.size(), 20u);
    EXPECT_EQ(points[19].x, 64 * 63 / 2 + 64 * 19);
  }
}

TEST_P(SchedulerTest, TellsWhereTheTimeWent) {
  FakeSource source(3);
  scheduler.add(std::make_unique<FakeTracker>(
                    1, [](auto) { std::this_thread::sleep_for(std::chrono::milliseconds(2)); }),
                "slow");
  scheduler.add(sink);
  scheduler.run(source);
  const std::vector<StageTime> times = scheduler.stage_times();
  ASSERT_EQ(times.size(), 4u);
  EXPECT_EQ(times[0].stage, "read");
  EXPECT_EQ(times[1].stage, "prepare");
  EXPECT_EQ(times[2].stage, "slow");
  EXPECT_EQ(times[3].stage, "sinks");
  EXPECT_GE(times[2].seconds, 0.006);
  for (const StageTime& t : times) EXPECT_GE(t.seconds, 0);
}

TEST_P(SchedulerTest, RunsOnce) {
  FakeSource source(2);
  scheduler.run(source);
  EXPECT_THROW(scheduler.run(source), std::logic_error);
}

TEST_P(SchedulerTest, KeepsTheLastFramesAloneIfTold) {
  FakeSource source(30);
  scheduler.add(std::make_unique<FakeTracker>(2));
  scheduler.add(sink);
  scheduler.keep(5);
  scheduler.run(source);
  EXPECT_EQ(sink.counts, std::vector<std::size_t>(30, 2));
  const auto kept = scheduler.logs()[0]->revised();
  ASSERT_EQ(kept.size(), 10u);
  EXPECT_EQ(kept.front().frame, 25);
}

}  // namespace
}  // namespace glint::test

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/scheduler.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <stdexcept>
#include <thread>

namespace glint {
namespace {

constexpr std::int64_t kNever = 1000;
using Hook = std::function<void(std::int64_t)>;

// `frames` small frames of noise-free pixels, one a second; `hook` sees the index before each read.
struct FakeSource : Source {
  explicit FakeSource(
      std::int64_t frames, Hook h = [](std::int64_t) {})
      : count(frames), hook(std::move(h)) {}
  std::optional<SourceFrame> next() override {
    if (read == count) return std::nullopt;
    hook(read);
    auto pixels = std::make_shared<std::vector<float>>(16 * 12);
    for (std::size_t i = 0; i < pixels->size(); ++i) (*pixels)[i] = float((i * 37 + read) % 11);
    SourceFrame frame;
    frame.pixels = {pixels->data(), 16, 12, 1, 16};
    frame.owner = pixels;
    frame.time = static_cast<double>(read++);
    return frame;
  }
  std::int64_t count;
  Hook hook;
  std::atomic<std::int64_t> read = 0;
};

// Reports `tracks` points a frame and revises the frame before.
struct FakeTracker : Tracker {
  explicit FakeTracker(
      std::int64_t n, Hook h = [](std::int64_t) {})
      : tracks(n), hook(std::move(h)) {}
  Feed feed() const override { return Feed::frames; }
  void step(const Scan& scan, TrackLog& log) override {
    hook(scan.frame);
    for (std::int64_t id = tracks; id-- > 0;) {
      TrackPoint p;
      p.frame = scan.frame;
      p.time = scan.time;
      p.track_id = id;
      p.x = sum += static_cast<double>(scan.frame + id);
      log.report(p);
      p.frame = scan.frame - 1;
      if (p.frame >= 0) log.revise(p);
    }
  }
  void finish(TrackLog& log) override { log.confirm(0, 0); }
  std::int64_t tracks;
  Hook hook;
  double sum = 0;
};

struct FakeSink : Sink {
  explicit FakeSink(Hook h = [](std::int64_t) {}) : hook(std::move(h)) {}
  void take(const ScanResult& result) override {
    hook(result.scan.frame);
    frames.push_back(result.scan.frame);
    for (const auto& points : result.reported) {
      counts.push_back(points.size());
      for (const TrackPoint& p : points) EXPECT_EQ(p.frame, result.scan.frame);
    }
  }
  Hook hook;
  std::vector<std::int64_t> frames;
  std::vector<std::size_t> counts;
};

std::vector<std::int64_t> first(std::int64_t n) {
  std::vector<std::int64_t> frames;
  for (std::int64_t f = 0; f < n; ++f) frames.push_back(f);
  return frames;
}

Hook throws_at(std::int64_t when, const std::string& message) {
  return [when, message](std::int64_t frame) {
    if (frame == when) throw std::runtime_error(message);
  };
}

Scheduler scheduler_on(const Device& device) {
  FramesConfig frames;
  frames.background = "none";
  return {device, FramePreparer(frames, device)};
}

std::string error_of(Scheduler& scheduler, Source& source) {
  try {
    scheduler.run(source);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "none";
}

struct SchedulerTest : ::testing::TestWithParam<int> {
  // More threads than the machine has cores are only had with this.
  tbb::global_control control{tbb::global_control::max_allowed_parallelism, 8};
  // 0 is the serial device.
  Device device = GetParam() == 0 ? Device::serial() : Device::tbb(GetParam());
  Scheduler scheduler = scheduler_on(device);
  FakeSink sink;
};
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

TEST_P(SchedulerTest, SourceFailureComesOutAfterAllEarlierFrames) {
  FakeSource source(kNever, throws_at(9, "clip.mp4: truncated"));
  scheduler.add(std::make_unique<FakeTracker>(1));
  scheduler.add(sink);
  EXPECT_EQ(error_of(scheduler, source), "clip.mp4: truncated");
  EXPECT_EQ(sink.frames, first(9));
  EXPECT_EQ(scheduler.frames(), 9);
  EXPECT_EQ(scheduler.logs().at(0)->online().size(), 9u);
}

TEST_P(SchedulerTest, PreparerFailureComesOutAfterAllEarlierFrames) {
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

TEST_P(SchedulerTest, TrackerFailureComesOutAfterAllEarlierFrames) {
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

TEST_P(SchedulerTest, SinkFailureStopsTheRun) {
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
TEST_P(SchedulerTest, FailureOfTheEarliestFrameIsTheOneThatComesOut) {
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

TEST_P(SchedulerTest, FinishFailureComesOutAfterAllFrames) {
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

}  // namespace
}  // namespace glint

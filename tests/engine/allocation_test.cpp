// SPDX-License-Identifier: Apache-2.0
// No allocation per frame once warm. An executable of its own: it counts every operator new.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "counted_allocations.hpp"
#include "glint/engine/frames/point_finder.hpp"
#include "glint/engine/scenario/scenes.hpp"
#include "glint/engine/trackers/registry.hpp"

namespace glint {
namespace {

using test::allocations;

constexpr std::int64_t kWarmUp = 100, kFrames = 140;
constexpr std::size_t kPoints = 10000;

// Two bright targets for all the time, rendered beforehand.
class Film : public Source {
 public:
  Film() {
    CrossingScene config;
    config.frames = kFrames;
    SceneSource source(make_scene(config), 1);
    while (auto frame = source.next()) frames_.push_back(*frame);
  }
  std::optional<SourceFrame> next() override {
    if (at_ == frames_.size()) return std::nullopt;
    return frames_[at_++];
  }

 private:
  std::vector<SourceFrame> frames_;
  std::size_t at_ = 0;
};

std::unique_ptr<Tracker> standard_tracker(const Device& device, const char* name = "smc-phd") {
  const TrackerEntry& entry = find_tracker(name);
  return entry.make(entry.config(), device, 1);
}

TEST(Allocation, IsCounted) {
  const std::size_t before = allocations;
  const auto image = std::make_unique<Image<float>>(8, 8);
  EXPECT_GE(allocations - before, 2u);
}

TEST(Allocation, NoneInAWarmPreparer) {
  Film film;
  FramePreparer preparer(FramesConfig{}, Device::tbb(2));
  std::size_t before = 0;
  for (std::int64_t frame = 0; auto next = film.next(); ++frame) {
    if (frame == kWarmUp) before = allocations;
    preparer.prepare(next->pixels, frame, next->time);
  }
  EXPECT_EQ(allocations - before, 0u);
}

TEST(Allocation, NoneInAWarmPointFinder) {
  for (const auto detector :
       {PointDetector::matched_filter, PointDetector::wavelet, PointDetector::unit_5x5}) {
    Film film;
    const Device device = Device::tbb(2);
    FramePreparer preparer(FramesConfig{}, device);
    PointsConfig config;
    config.detector = detector;
    config.threshold = 3, config.unit_threshold = 0;
    PointFinder finder(config, device);
    std::vector<PointMeasurement> points;
    std::size_t before = 0, found = 0;
    for (std::int64_t frame = 0; auto next = film.next(); ++frame) {
      if (frame == kWarmUp) before = allocations, found = 0;
      finder.find(preparer.prepare(next->pixels, frame, next->time), points);
      found += points.size();
    }
    EXPECT_EQ(allocations - before, 0u) << static_cast<int>(detector);
    EXPECT_GT(found, 0u);
  }
}

class WarmTracker : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Allocation, WarmTracker,
                         testing::Values("smc-phd", "smc-phd-improved", "mm-phd", "mm-pf"));

TEST_P(WarmTracker, AllocatesNothing) {
  Film film;
  const Device device = Device::tbb(2);
  FramePreparer preparer(FramesConfig{}, device);
  const auto tracker = standard_tracker(device, GetParam());
  TrackLog log;
  log.reserve(kPoints);
  std::size_t before = 0;
  for (std::int64_t frame = 0; auto next = film.next(); ++frame) {
    if (frame == kWarmUp) before = allocations;
    tracker->step(preparer.prepare(next->pixels, frame, next->time), log);
  }
  EXPECT_EQ(allocations - before, 0u);
  EXPECT_FALSE(log.online().empty());
}

// However long the stream: the room of what is forgotten serves what comes.
TEST(Allocation, NoneInALogThatForgets) {
  TrackLog log;
  std::size_t before = 0;
  for (std::int64_t frame = 0; frame < 20000; ++frame) {
    if (frame == 200) before = allocations;
    TrackPoint p;
    for (p.track_id = frame % 7; p.track_id < 20; ++p.track_id) {
      p.frame = frame;
      log.report(p);
      p.frame = frame - 3;
      log.revise(p);
    }
    if (frame % 11 == 0) log.drop(15, frame - 5);
    log.forget(frame - 50);
  }
  EXPECT_EQ(allocations - before, 0u);
  EXPECT_EQ(log.online().front().frame, 19949);
}

// Remembers the count as frames go by.
class Counter : public Sink {
 public:
  void take(const ScanResult& result) override {
    if (result.scan.frame == kWarmUp) at_warm_up_ = allocations;
    at_last_ = allocations;
  }
  std::size_t since_warm_up() const { return at_last_ - at_warm_up_; }

 private:
  std::size_t at_warm_up_ = 0, at_last_ = 0;
};

TEST(Allocation, NoneInAWarmPipeline) {
  Film film;
  const Device device = Device::tbb(2);
  Scheduler scheduler(device, FramePreparer(FramesConfig{}, device));
  scheduler.add(standard_tracker(device), "smc-phd");
  scheduler.reserve(kPoints);
  Counter counter;
  scheduler.add(counter);
  EXPECT_EQ(scheduler.run(film), kFrames);
  EXPECT_EQ(counter.since_warm_up(), 0u);
}

}  // namespace
}  // namespace glint

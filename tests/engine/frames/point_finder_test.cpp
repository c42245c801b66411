// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/frames/point_finder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "engine/scheduler_fakes.hpp"
#include "glint/engine/trackers/registry.hpp"

namespace glint::test {
namespace {

// Remembers how many points each scan brought, and that they are those of its own frame.
struct PointTracker : FakeTracker {
  PointTracker(Feed f, PointFinder with) : FakeTracker(1), fed(f), finder(std::move(with)) {}
  Feed feed() const override { return fed; }
  void step(const Scan& scan, TrackLog&) override {
    counts.push_back(scan.points.size());
    finder.find(scan, own);
    EXPECT_TRUE(scan.points.empty() || std::ranges::equal(scan.points, own));
  }
  Feed fed;
  PointFinder finder;
  std::vector<PointMeasurement> own;
  std::vector<std::size_t> counts;
};

std::vector<std::size_t> counts_of(Feed feed, const PointsConfig& config, const Device& device) {
  FramesConfig frames;
  frames.background = BackgroundKind::none;
  Scheduler scheduler(device, FramePreparer(frames, device), config);
  auto tracker = std::make_unique<PointTracker>(feed, PointFinder(config, device));
  const PointTracker& told = *tracker;
  scheduler.add(std::move(tracker));
  FakeSource source(20);
  scheduler.run(source);
  return told.counts;
}

TEST(Points, ReachTheTrackersThatFeedOnThem) {
  PointsConfig config;
  config.radius = 1;
  for (const Device& device : {Device::serial(), Device::tbb(2)}) {
    for (const Feed feed : {Feed::points, Feed::both}) {
      const auto counts = counts_of(feed, config, device);
      ASSERT_EQ(counts.size(), 20u);
      for (const std::size_t count : counts) EXPECT_GT(count, 0u);
    }
    for (const std::size_t count : counts_of(Feed::frames, config, device)) EXPECT_EQ(count, 0u);
  }
}

TEST(Points, SinksGetThemWhereNoTrackerFeedsOnThem) {
  Scheduler scheduler = scheduler_on(Device::tbb(2));
  struct CountingSink : Sink {
    void take(const ScanResult& result) override { points += result.scan.points.size(); }
    std::size_t points = 0;
  } sink;
  scheduler.add(sink);
  scheduler.find_points();
  FakeSource source(5);
  scheduler.run(source);
  EXPECT_GT(sink.points, 0u);
}

Scan scan_of(Image<float> raw) {
  Scan scan;
  scan.raw = Frame(std::make_shared<const Image<float>>(std::move(raw)));
  return scan;
}

// 20x10 pixels of 10, but one block of 14: the frame's mean is 10.5.
TEST(Points, UnitsAreBlocksAboveTheFramesMeanIntensity) {
  Image<float> raw(20, 10);
  for (int y = 0; y < 10; ++y) std::fill_n(raw.view().row(y), 20, 10.0F);
  for (int y = 5; y < 10; ++y) std::fill_n(raw.view().row(y) + 10, 5, 14.0F);
  const Scan scan = scan_of(std::move(raw));
  std::vector<PointMeasurement> points;
  for (const Device& device : {Device::serial(), Device::tbb(2)}) {
    PointsConfig config;
    config.mode = FindPoints::Mode::unit_5x5;
    config.unit_threshold = 14 / 10.5 - 1e-4;
    PointFinder(config, device).find(scan, points);
    EXPECT_EQ(points, (std::vector<PointMeasurement>{{12, 7, 14}}));
    config.unit_threshold = 14 / 10.5 + 1e-4;
    PointFinder(config, device).find(scan, points);
    EXPECT_TRUE(points.empty());
  }
}

TEST(Points, OfAScanWithoutFramesAreNone) {
  for (const auto mode : {FindPoints::Mode::local_maximum, FindPoints::Mode::unit_5x5}) {
    PointsConfig config;
    config.mode = mode;
    std::vector<PointMeasurement> points(3);
    PointFinder(config, Device::tbb(2)).find(Scan{}, points);
    EXPECT_TRUE(points.empty()) << static_cast<int>(mode);
  }
}

TEST(Points, TheRegistryKnowsWhatEachTrackerFeedsOn) {
  for (const TrackerEntry& entry : all_trackers()) {
    EXPECT_EQ(entry.feed, entry.make(entry.config(), Device::serial(), 1)->feed()) << entry.name;
  }
}

}  // namespace
}  // namespace glint::test

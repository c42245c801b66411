// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/frames/point_finder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "engine/scheduler_fakes.hpp"
#include "glint/engine/trackers/registry.hpp"
#include "glint/kernels/core/random.hpp"

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
  config.radius = 1, config.threshold = 0.3, config.wavelet_k = 0;
  for (const auto detector : {PointDetector::matched_filter, PointDetector::wavelet}) {
    config.detector = detector;
    SCOPED_TRACE(static_cast<int>(detector));
    for (const Device& device : {Device::serial(), Device::tbb(2)}) {
      for (const Feed feed : {Feed::points, Feed::both}) {
        const auto counts = counts_of(feed, config, device);
        ASSERT_EQ(counts.size(), 20u);
        for (const std::size_t count : counts) EXPECT_GT(count, 0u);
      }
      for (const std::size_t count : counts_of(Feed::frames, config, device)) EXPECT_EQ(count, 0u);
    }
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

struct Spot {
  double x, y, sigma, height;
};

/// Spots on a ground of 0.01: pixels of exactly 0 would be masked ones.
Scan scan_of(const std::vector<Spot>& spots) {
  Image<float> frame(90, 80);
  for (int y = 0; y < 80; ++y) {
    for (int x = 0; x < 90; ++x) {
      double sum = 0.01;
      for (const Spot& s : spots) {
        const double r2 = (x - s.x) * (x - s.x) + (y - s.y) * (y - s.y);
        sum += s.height * std::exp(-r2 / (2 * s.sigma * s.sigma));
      }
      frame.view()(x, y) = static_cast<float>(sum);
    }
  }
  Scan scan;
  scan.whitened = Frame(std::make_shared<const Image<float>>(std::move(frame)));
  return scan;
}

TEST(Points, EitherFilterFindsATargetBetweenPixels) {
  const Scan scan = scan_of({{30.3, 20.6, 1, 30}});
  for (const auto detector : {PointDetector::matched_filter, PointDetector::wavelet}) {
    PointsConfig config;
    config.detector = detector;
    std::vector<PointMeasurement> points;
    PointFinder(config, Device::serial()).find(scan, points);
    ASSERT_EQ(points.size(), 1U) << static_cast<int>(detector);
    EXPECT_NEAR(points[0].x, 30.3, 0.05);
    EXPECT_NEAR(points[0].y, 20.6, 0.05);
    EXPECT_GT(points[0].amplitude, 20);
  }
}

TEST(Points, OfWaveletsAreSpotsOfSeveralSizesThatAScaleFindsSignificant) {
  const Scan scan = scan_of({{20, 20, 0.6, 9}, {60, 50, 3.2, 9}});
  PointsConfig config;
  config.detector = PointDetector::wavelet;
  std::vector<PointMeasurement> points;
  const auto count = [&](double k, double threshold) {
    config.wavelet_k = k, config.threshold = threshold;
    PointFinder(config, Device::serial()).find(scan, points);
    return points.size();
  };
  ASSERT_EQ(count(1, 2), 2U);
  EXPECT_NEAR(points[0].x, 20, 0.01);
  EXPECT_NEAR(points[1].y, 50, 0.01);
  const double small = points[0].amplitude, large = points[1].amplitude;
  ASSERT_LT(small, large);
  EXPECT_EQ(count(1, small + 0.01), 1U);
  EXPECT_EQ(count(1, large + 0.01), 0U);
  EXPECT_EQ(count(1000, -100), 0U);  // no threshold makes points of nothing
}

// Noise beside the mask is smoothed into it.
TEST(Points, OfWaveletsAreNotMasked) {
  constexpr int kWidth = 60, kMasked = 30;  // the columns below are masked
  Image<float> frame(kWidth, kWidth);
  for (int y = 0; y < kWidth; ++y) {
    for (int x = kMasked; x < kWidth; ++x) {
      const auto item = static_cast<std::uint32_t>(y * kWidth + x);
      frame.view()(x, y) = random_normals(random_key(5, 0, Purpose::trial), item).n[0];
    }
  }
  Scan scan;
  scan.whitened = Frame(std::make_shared<const Image<float>>(std::move(frame)));
  PointsConfig config;
  config.detector = PointDetector::wavelet;
  config.radius = 1, config.threshold = 0, config.wavelet_k = 0;
  std::vector<PointMeasurement> points;
  PointFinder(config, Device::serial()).find(scan, points);
  EXPECT_GT(points.size(), 20U);
  for (const PointMeasurement& p : points) EXPECT_GE(p.x, kMasked - 0.5);
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
    config.detector = PointDetector::unit_5x5;
    config.unit_threshold = 14 / 10.5 - 1e-4;
    PointFinder(config, device).find(scan, points);
    EXPECT_EQ(points, (std::vector<PointMeasurement>{{12, 7, 14}}));
    config.unit_threshold = 14 / 10.5 + 1e-4;
    PointFinder(config, device).find(scan, points);
    EXPECT_TRUE(points.empty());
  }
}

TEST(Points, OfAScanWithoutFramesAreNone) {
  for (const auto detector :
       {PointDetector::matched_filter, PointDetector::wavelet, PointDetector::unit_5x5}) {
    PointsConfig config;
    config.detector = detector;
    std::vector<PointMeasurement> points(3);
    PointFinder(config, Device::tbb(2)).find(Scan{}, points);
    EXPECT_TRUE(points.empty()) << static_cast<int>(detector);
  }
}

TEST(Points, TheRegistryKnowsWhatEachTrackerFeedsOn) {
  for (const TrackerEntry& entry : all_trackers()) {
    EXPECT_EQ(entry.feed, entry.make(entry.config(), Device::serial(), 1)->feed()) << entry.name;
  }
}

}  // namespace
}  // namespace glint::test

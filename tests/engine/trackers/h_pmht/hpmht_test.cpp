// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "glint/engine/scenario/scenario.hpp"
#include "glint/engine/trackers/h_pmht/h_pmht.hpp"

namespace glint {
namespace {

ScriptedTarget straight(int birth, int death, const Kinematics& start, double snr = 16) {
  ScriptedTarget t;
  t.birth = birth, t.death = death;
  t.intensity = PointSpread::of(1).intensity_of_snr(snr);
  t.path = fly(start);
  return t;
}

Scene scene_of(std::vector<ScriptedTarget> targets, int frames = 24, int width = 48,
               int height = 48) {
  Scene s;
  s.name = "test", s.width = width, s.height = height, s.frames = frames;
  s.point_spread = PointSpread::of(1);
  s.targets = std::move(targets);
  return s;
}

Scan scan_of(const Scene& scene, int k, std::uint64_t seed = 1) {
  Scan scan;
  scan.frame = k, scan.time = k * scene.interval;
  scan.whitened = Frame(render(scene, seed, k));
  return scan;
}

TrackLog track(const Scene& scene, const HPmhtConfig& config = {}, std::uint64_t seed = 1) {
  TrackLog log;
  HPmht tracker(config, Device::tbb(1), seed);
  for (int k = 0; k < scene.frames; ++k) tracker.step(scan_of(scene, k, seed), log);
  tracker.finish(log);
  return log;
}

std::set<std::int64_t> ids_of(const std::vector<TrackPoint>& points) {
  std::set<std::int64_t> ids;
  for (const auto& p : points) ids.insert(p.track_id);
  return ids;
}

/// Largest distance from a living target to the nearest point of `points`, frames `from` to `to`.
double worst_error(const std::vector<TrackPoint>& points, const Scene& scene, int from, int to) {
  double worst = 0;
  for (int k = from; k < to; ++k) {
    for (const auto& t : truth_at(scene, k)) {
      double nearest = 1e9;
      for (const auto& p : points) {
        if (p.frame == k) nearest = std::min(nearest, std::hypot(p.x - t.x, p.y - t.y));
      }
      worst = std::max(worst, nearest);
    }
  }
  return worst;
}

TEST(HPmht, FindsATargetAndTracesItBackToWhereItAppeared) {
  const Scene scene = scene_of({straight(4, 24, {10, 12, 1.2, 0.7})});
  const TrackLog log = track(scene);
  EXPECT_EQ(ids_of(log.online()).size(), 1u);
  EXPECT_TRUE(log.at(7).empty());
  EXPECT_LT(worst_error(log.online(), scene, 9, 24), 1.5);
  EXPECT_LT(worst_error(log.revised(), scene, 4, 24), 1.5);
  for (const auto& p : log.online()) EXPECT_EQ(p.status, TrackStatus::confirmed);
}

TEST(HPmht, SeesNothingInNoise) { EXPECT_TRUE(track(scene_of({}, 40)).online().empty()); }

TEST(HPmht, EndsATrackWhoseTargetVanishesAndTakesBackItsLastPoints) {
  const Scene scene = scene_of({straight(0, 14, {10, 12, 1.2, 0.7})}, 30);
  const TrackLog log = track(scene);
  bool halted = false;
  for (const auto& p : log.online()) halted |= p.status == TrackStatus::halted;
  EXPECT_TRUE(halted);
  EXPECT_FALSE(log.at(13).empty());
  EXPECT_TRUE(log.at(22).empty());
  for (const auto& p : log.revised()) EXPECT_LT(p.frame, 16);
}

TEST(HPmht, KeepsTwoCrossingTargetsApart) {
  const Scene scene = scene_of(
      {straight(0, 30, {6, 10, 1.2, 0.8}, 18), straight(0, 30, {41, 10, -1.2, 0.8}, 18)}, 30);
  const TrackLog log = track(scene);
  ASSERT_EQ(log.at(29).size(), 2u);
  EXPECT_EQ(ids_of(log.online()).size(), 2u);
  for (const auto& p : log.at(29)) {
    const auto before = log.at(8);
    for (const auto& q : before) {
      if (q.track_id == p.track_id) {
        EXPECT_GT(p.vx * q.vx, 0) << "identities swapped";
      }
    }
  }
}

TEST(HPmht, CoastsThroughAnEmptyFrame) {
  const Scene scene = scene_of({straight(0, 24, {10, 12, 1.2, 0.7})});
  for (const bool masked : {false, true}) {
    TrackLog log;
    HPmht tracker(HPmhtConfig{}, Device::tbb(1), 1);
    for (int k = 0; k < scene.frames; ++k) {
      Scan scan = scan_of(scene, k);
      if (k == 15) {
        Image<float> blank(48, 48);
        const float pixel = masked ? std::numeric_limits<float>::quiet_NaN() : 0;
        for (int y = 0; y < 48; ++y) std::fill_n(blank.view().row(y), 48, pixel);
        scan.whitened = Frame(std::move(blank));
      }
      tracker.step(scan, log);
    }
    EXPECT_EQ(ids_of(log.online()).size(), 1u);
    EXPECT_LT(worst_error(log.online(), scene, 9, 24), 2);
  }
}

TEST(HPmht, GoesOnAfterAScanWithoutAFrame) {
  const Scene scene = scene_of({straight(0, 24, {10, 12, 1.2, 0.7})});
  TrackLog log;
  HPmht tracker(HPmhtConfig{}, Device::tbb(1), 1);
  for (int k = 0; k < scene.frames; ++k) {
    tracker.step(k == 12 || k == 13 ? Scan{} : scan_of(scene, k), log);
  }
  EXPECT_EQ(ids_of(log.online()).size(), 1u);
  EXPECT_LT(worst_error(log.online(), scene, 14, 24), 1.5);
}

TEST(HPmht, FollowsATargetAlongTheBorder) {
  const Scene scene = scene_of({straight(0, 24, {5, 0, 0.9, 0}, 18)});
  EXPECT_LT(worst_error(track(scene).online(), scene, 8, 24), 1.5);
}

TEST(HPmht, FollowsAHundredTargets) {
  std::vector<ScriptedTarget> targets;
  for (int row = 1; row <= 10; ++row) {
    for (int column = 1; column <= 10; ++column) {
      targets.push_back(straight(0, 16, {20.0 * column, 20.0 * row, 0.8, -0.6}, 20));
    }
  }
  const Scene scene = scene_of(std::move(targets), 16, 220, 220);
  const TrackLog log = track(scene);
  EXPECT_NEAR(static_cast<double>(log.at(15).size()), 100, 3);
  EXPECT_LT(worst_error(log.revised(), scene, 8, 16), 2);
}

TEST(HPmht, TakesEmptyTinyAndSingleFrames) {
  TrackLog log;
  HPmht(HPmhtConfig{}, Device::serial(), 1).step(Scan{}, log);
  for (const auto& [w, h] : {std::pair{1, 1}, {3, 2}}) {
    HPmht small(HPmhtConfig{}, Device::serial(), 1);
    for (int k = 0; k < 9; ++k) {
      Scan scan;
      scan.frame = k, scan.time = k;
      scan.whitened = Frame(Image<float>(w, h));
      small.step(scan, log);
    }
  }
  EXPECT_TRUE(log.online().empty());
}

TEST(HPmht, StartsFromAKnownStateAndMovesWithTheScansAfterIt) {
  const Scene scene = scene_of({straight(0, 12, {10, 12, 1.2, 0.7})}, 12);
  HPmhtConfig config;
  config.initiate = false;
  HPmht tracker(config, Device::tbb(1), 1);
  tracker.start(10, 12, 1.2, 0.7);
  TrackLog log;
  for (int k = 0; k < scene.frames; ++k) tracker.step(scan_of(scene, k), log);
  ASSERT_EQ(log.at(0).size(), 1u);
  EXPECT_EQ(log.at(0)[0].x, 10);
  EXPECT_EQ(ids_of(log.online()).size(), 1u);
  EXPECT_LT(worst_error(log.online(), scene, 0, 12), 1.5);
}

TEST(HPmht, ReportsVelocityInPixelsPerSecond) {
  Scene scene = scene_of({straight(0, 20, {10, 8, 0.9, 0.3}, 20)}, 20);
  TrackLog log;
  HPmht tracker(HPmhtConfig{}, Device::tbb(1), 1);
  for (int k = 0; k < scene.frames; ++k) {
    Scan scan = scan_of(scene, k);
    scan.time = k * 0.1;  // ten frames a second
    tracker.step(scan, log);
  }
  ASSERT_EQ(log.at(19).size(), 1u);
  EXPECT_NEAR(log.at(19)[0].vx, 9, 3);
  EXPECT_NEAR(log.at(19)[0].vy, 3, 3);
}

/// A dark blot of 9x9 pixels that moves over a sky of 2 (reciprocal levels), itself 8.
Frame dark_aircraft(int k) {
  Image<float> image(120, 100);
  for (int y = 0; y < 100; ++y) std::fill_n(image.view().row(y), 120, 2.0F);
  for (int y = 36; y < 45; ++y) std::fill_n(image.view().row(y) + 16 + 5 * k, 9, 8.0F);
  return Frame(std::move(image));
}

TEST(HPmht, FollowsTheCentroidOfAnExtendedTargetInReciprocalIntensity) {
  for (const CellThreshold threshold : {CellThreshold::keep, CellThreshold::subtract}) {
    HPmhtConfig config;
    config.intensity = CellIntensity::rpim, config.threshold = threshold, config.initiate = false;
    config.estimate_extent = true, config.extent = 16;
    config.batch = 5, config.process_noise = 1;
    HPmht tracker(config, Device::tbb(1), 1);
    tracker.start(22, 41, 3, 1);
    TrackLog log;
    for (int k = 0; k < 12; ++k) {
      Scan scan;
      scan.frame = k, scan.time = k, scan.raw = dark_aircraft(k);
      tracker.step(scan, log);
    }
    ASSERT_EQ(log.at(11).size(), 1u) << static_cast<int>(threshold);
    EXPECT_NEAR(log.at(11)[0].x, 20 + 5 * 11, 0.6) << static_cast<int>(threshold);
    EXPECT_NEAR(log.at(11)[0].y, 40, 0.6) << static_cast<int>(threshold);
  }
}

TEST(HPmht, RefusesWhatDoesNotFitTogether) {
  HPmhtConfig c;
  c.batch = 4;
  EXPECT_THROW(HPmht(c, Device::serial(), 1), ConfigError);
  HPmhtConfig d;
  d.extent_low = 10, d.extent_high = 5;
  EXPECT_THROW(HPmht(d, Device::serial(), 1), ConfigError);
}

}  // namespace
}  // namespace glint

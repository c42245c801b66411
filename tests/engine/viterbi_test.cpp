// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/viterbi.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "glint/engine/scenario/scenario.hpp"

namespace glint {
namespace {

/// A window of 5 stages over a 30x20 frame of this score with a straight path of 10 a stage in it.
PathWindow window_with_path(const Device& device, int first, int last, float elsewhere = -1) {
  PathWindow window(5, 3, device);
  for (int k = 0; k < 5; ++k) {
    const ImageView<float> map = window.next(30, 20);
    for (int y = 0; y < 20; ++y) std::fill_n(map.row(y), 30, elsewhere);
    if (k >= first && k < last) map(5 + 2 * k, 4 + k) = 10;
    window.push({3, 5});  // in a flat first stage ties set the move
  }
  return window;
}

TEST(PathWindow, TracesThePathBack) {
  PathWindow window = window_with_path(Device::tbb(1), 0, 5);
  const auto paths = window.find(30);
  ASSERT_EQ(paths.size(), 1u);
  EXPECT_EQ(paths[0].total, 50);
  EXPECT_EQ(paths[0].first, 0u);
  EXPECT_EQ(paths[0].last, 5u);
  for (int k = 0; k < 5; ++k) {
    EXPECT_EQ(paths[0].cells[static_cast<std::size_t>(k)].x, 5 + 2 * k);
    EXPECT_EQ(paths[0].cells[static_cast<std::size_t>(k)].y, 4 + k);
  }
}

TEST(PathWindow, TrimsStagesThatShowNothing) {
  PathWindow window = window_with_path(Device::tbb(1), 1, 4);
  const auto paths = window.find(20);
  ASSERT_EQ(paths.size(), 1u);
  EXPECT_EQ(paths[0].first, 1u);
  EXPECT_EQ(paths[0].last, 4u);
}

TEST(PathWindow, KeepsNoPathUnderTheThresholdOrOfAWindowThatIsNotFull) {
  PathWindow window = window_with_path(Device::tbb(1), 0, 2);
  EXPECT_TRUE(window.find(20).empty());
  PathWindow other(2, 3, Device::tbb(1));
  other.next(4, 4), other.push({});
  EXPECT_FALSE(other.full());
}

TEST(PathWindow, AnotherSizeStartsAnew) {
  PathWindow window = window_with_path(Device::tbb(1), 0, 5);
  window.next(8, 8), window.push({});
  EXPECT_FALSE(window.full());
}

ViterbiConfig config_for(double snr) {
  ViterbiConfig c;
  c.psf_sigma = 0.7;
  c.snr_low = snr - 2, c.snr_high = snr + 2;
  c.speed_max = 2;
  return c;
}

Scene scene_of(int targets, double snr, int birth, int death, int frames = 30) {
  Scene s;
  s.width = s.height = 40, s.frames = frames;
  s.point_spread = PointSpread::of(0.7);
  const double intensity = s.point_spread.intensity_of_snr(snr);
  if (targets > 0) s.targets.push_back({birth, death, intensity, fly({6, 8, 0.9, 0.3})});
  if (targets > 1) s.targets.push_back({birth, death, intensity, fly({32, 30, -0.8, -0.4})});
  return s;
}

TrackLog track(const Scene& scene, const ViterbiConfig& config, std::uint64_t seed = 1) {
  TrackLog log;
  Viterbi tracker(config, Device::tbb(1), seed);
  for (int k = 0; k < scene.frames; ++k) {
    Scan scan;
    scan.frame = k, scan.time = k * scene.interval;
    scan.whitened = Frame(render(scene, seed, k));
    tracker.step(scan, log);
  }
  return log;
}

std::map<std::int64_t, std::vector<TrackPoint>> by_track(const std::vector<TrackPoint>& points) {
  std::map<std::int64_t, std::vector<TrackPoint>> tracks;
  for (const TrackPoint& p : points) tracks[p.track_id].push_back(p);
  return tracks;
}

TEST(Viterbi, FollowsEachTargetUnderOneIdentityFromItsBirth) {
  const Scene scene = scene_of(2, 16, 3, 30);
  const TrackLog log = track(scene, config_for(16));
  const auto tracks = by_track(log.revised());
  ASSERT_EQ(tracks.size(), 2u);
  for (const auto& [id, points] : tracks) {
    EXPECT_NEAR(static_cast<double>(points.front().frame), 3, 1);
    EXPECT_EQ(points.back().frame, 29);
    for (const TrackPoint& p : points) {
      double nearest = 1e9;
      for (const auto& t : truth_at(scene, static_cast<int>(p.frame))) {
        nearest = std::min(nearest, std::hypot(p.x - t.x, p.y - t.y));
      }
      EXPECT_LT(nearest, 2) << id << " at " << p.frame;
    }
  }
}

TEST(Viterbi, ReportsNothingBeforeItsWindowIsFull) {
  const TrackLog log = track(scene_of(1, 18, 0, 30), config_for(18));
  EXPECT_EQ(log.online().front().frame, 7);
  EXPECT_EQ(log.revised().front().frame, 0);
}

TEST(Viterbi, KnowsTheVelocity) {
  Scene scene = scene_of(1, 18, 0, 30);
  scene.interval = 0.5;
  scene.targets[0].path = fly({6, 8, 1.8, 0.6});
  double sum = 0, count = 0;
  for (const TrackPoint& p : track(scene, config_for(18)).revised()) sum += p.vx, ++count;
  EXPECT_NEAR(sum / count, 1.8, 0.15);
}

TEST(Viterbi, EndsATrackWhoseTargetVanishes) {
  const TrackLog log = track(scene_of(1, 16, 2, 15), config_for(16));
  const auto online = log.online();
  EXPECT_EQ(std::ranges::count(online, TrackStatus::halted, &TrackPoint::status), 1);
  EXPECT_NEAR(static_cast<double>(log.revised().back().frame), 14, 1);
}

TEST(Viterbi, DeclaresLittleInNoise) {
  std::size_t declared = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    declared += by_track(track(scene_of(0, 10, 0, 0, 40), config_for(12), seed).online()).size();
  }
  EXPECT_LE(declared, 1u);
}

TEST(Viterbi, AHigherThresholdDeclaresLater) {
  ViterbiConfig lax = config_for(12), strict = lax;
  lax.threshold = 15, strict.threshold = 45;
  const Scene scene = scene_of(1, 12, 10, 30);
  const auto first = [&](const ViterbiConfig& config) {
    const auto points = track(scene, config).online();
    return points.empty() ? std::int64_t{99} : points.front().frame;
  };
  EXPECT_LT(first(lax), first(strict));
}

TEST(Viterbi, TakesEmptyAndTinyFrames) {
  Viterbi tracker(ViterbiConfig{}, Device::serial(), 1);
  TrackLog log;
  tracker.step(Scan{}, log);
  for (int k = 0; k < 10; ++k) {
    Scan scan;
    scan.frame = k;
    scan.whitened = Frame(Image<float>(3, 2));
    tracker.step(scan, log);
  }
  EXPECT_TRUE(log.online().empty());
}

TEST(Viterbi, RefusesACommonStretchLongerThanItsWindow) {
  ViterbiConfig config;
  config.window = 4, config.common_frames = 5;
  EXPECT_THROW(Viterbi(config, Device::serial(), 1), ConfigError);
}

}  // namespace
}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/mm_phd.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "glint/engine/scenario/scenario.hpp"

namespace glint {
namespace {

MmPhdConfig config_for(double snr) {
  MmPhdConfig c;
  c.psf_sigma = 0.7, c.jitter = 0;
  c.snr_low = snr - 2, c.snr_high = snr + 2;
  c.intensity_walk = 0.03;
  c.birth_particles = 2000;
  c.mask_half_width = 0, c.separation = 2;
  c.confirm_hits = 3, c.halt_misses = 2;
  return c;
}

ScriptedTarget target(int birth, int death, Kinematics start, double snr) {
  return {birth, death, PointSpread::of(0.7).intensity_of_snr(snr), fly(start)};
}

Scene scene_of(std::vector<ScriptedTarget> targets, int frames = 30) {
  Scene s;
  s.width = s.height = 40, s.frames = frames;
  s.point_spread = PointSpread::of(0.7);
  s.targets = std::move(targets);
  return s;
}

TrackLog track(const Scene& scene, const MmPhdConfig& config, std::uint64_t seed = 1) {
  TrackLog log;
  MmPhd tracker(config, Device::tbb(1), seed);
  for (int k = 0; k < scene.frames; ++k) {
    Scan scan;
    scan.frame = k, scan.time = k * scene.interval;
    scan.whitened = Frame(render(scene, seed, k));
    tracker.step(scan, log);
  }
  tracker.finish(log);
  return log;
}

std::vector<TrackPoint> confirmed(const std::vector<TrackPoint>& points) {
  std::vector<TrackPoint> kept;
  std::ranges::copy_if(points, std::back_inserter(kept),
                       [](const auto& p) { return p.status == TrackStatus::confirmed; });
  return kept;
}

std::set<std::int64_t> ids(const std::vector<TrackPoint>& points) {
  std::set<std::int64_t> set;
  for (const auto& p : points) set.insert(p.track_id);
  return set;
}

TEST(MmPhd, FollowsTwoTargetsUnderTwoIdentities) {
  const Scene scene =
      scene_of({target(3, 30, {6, 8, 0.9, 0.3}, 15), target(3, 30, {32, 30, -0.8, -0.4}, 15)});
  const auto points = confirmed(track(scene, config_for(15)).revised());
  EXPECT_EQ(ids(points).size(), 2u);
  for (const auto& p : points) {
    double nearest = 1e9;
    for (const auto& t : truth_at(scene, static_cast<int>(p.frame))) {
      nearest = std::min(nearest, std::hypot(p.x - t.x, p.y - t.y));
    }
    EXPECT_LT(nearest, 1.5) << "frame " << p.frame;
  }
}

/// First frame of the revised record; 99 if there is none.
std::int64_t first_frame(const Scene& scene, const MmPhdConfig& config, std::uint64_t seed) {
  const auto points = confirmed(track(scene, config, seed).revised());
  return points.empty() ? 99 : points.front().frame;
}

TEST(MmPhd, BackwardPassFindsWhereATrackCameFrom) {
  // Dim enough that detection takes several frames.
  const Scene scene = scene_of({target(5, 30, {6, 20, 0.9, 0.2}, 10)});
  int earlier = 0, before_birth = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    MmPhdConfig with = config_for(10), without = with;
    without.backward_frames = 0;
    const std::int64_t traced = first_frame(scene, with, seed);
    const std::int64_t detected = first_frame(scene, without, seed);
    EXPECT_LE(traced, detected);
    earlier += traced < detected;
    before_birth += traced < 4;
  }
  EXPECT_GE(earlier, 5);
  EXPECT_LE(before_birth, 1);
}

TEST(MmPhd, BackwardPassSeldomGoesBeyondTheBirthOfWhatWasDetectedAtOnce) {
  // The cloud at detection fits the noise of the frame before it, for two-frame births come from
  // there; traced from that cloud the 80 tracks have 11 points too many.
  int too_many = 0;
  for (const double snr : {12.0, 14.0}) {
    const Scene scene = scene_of({target(5, 13, {6, 20, 0.9, 0.2}, snr)}, 13);
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      too_many += std::max(0, 5 - static_cast<int>(first_frame(scene, config_for(snr), seed)));
    }
  }
  EXPECT_LE(too_many, 4);
}

TEST(MmPhd, EndsATrackAndDropsItsLastMisses) {
  const Scene scene = scene_of({target(2, 15, {6, 8, 0.9, 0.3}, 16)});
  const TrackLog log = track(scene, config_for(16));
  EXPECT_TRUE(std::ranges::any_of(log.online(),
                                  [](const auto& p) { return p.status == TrackStatus::halted; }));
  for (const auto& p : confirmed(log.revised())) EXPECT_LE(p.frame, 15);
}

TEST(MmPhd, ConfirmsNothingInNoise) {
  int false_tracks = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    false_tracks += static_cast<int>(
        ids(confirmed(track(scene_of({}, 40), config_for(10), seed).online())).size());
  }
  EXPECT_LE(false_tracks, 1);
}

TEST(MmPhd, TellsATurnFromAStraightLine) {
  Scene scene = scene_of({target(0, 30, {8, 20, 1, 0}, 20)});
  const auto straight = confirmed(track(scene, config_for(20)).online());
  double cv = 0;
  for (const auto& p : straight) {
    ASSERT_EQ(p.mode_probability.size(), 3u);
    cv += p.mode_probability[0];
    EXPECT_NEAR(p.mode_probability[0] + p.mode_probability[1] + p.mode_probability[2], 1, 1e-6);
  }
  EXPECT_GT(cv / static_cast<double>(straight.size()), 0.5);
}

TEST(MmPhd, TakesEmptyTinyAndGappedFrames) {
  MmPhd tracker(MmPhdConfig{}, Device::serial(), 1);
  TrackLog log;
  tracker.step(Scan{}, log);
  for (int k = 0; k < 6; k += 2) {
    Scan scan;
    scan.frame = k, scan.time = k;
    scan.whitened = Frame(Image<float>(3, 2));
    tracker.step(scan, log);
  }
  EXPECT_TRUE(log.online().empty());
}

}  // namespace
}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/mm_pf.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "glint/engine/scenario/scenario.hpp"

namespace glint {
namespace {

MmPfConfig config_for(double snr) {
  MmPfConfig c;
  c.psf_sigma = 0.7, c.jitter = 0;
  c.snr_low = snr - 2, c.snr_high = snr + 2;
  c.intensity_walk = 0.03;
  c.birth_particles = 2000;
  c.mask_half_width = 0, c.separation = 2;
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

TrackLog track(const Scene& scene, const MmPfConfig& config, std::uint64_t seed = 1) {
  TrackLog log;
  MmPf tracker(config, Device::tbb(1), seed);
  for (int k = 0; k < scene.frames; ++k) {
    Scan scan;
    scan.frame = k, scan.time = k * scene.interval;
    scan.whitened = Frame(render(scene, seed, k));
    tracker.step(scan, log);
  }
  return log;
}

std::set<std::int64_t> confirmed_ids(const TrackLog& log) {
  std::set<std::int64_t> ids;
  for (const auto& p : log.online()) {
    if (p.status == TrackStatus::confirmed) ids.insert(p.track_id);
  }
  return ids;
}

TEST(MmPf, DeclaresTargetsOneAfterTheOther) {
  const Scene scene = scene_of(2, 15, 3, 30);
  const TrackLog log = track(scene, config_for(15));
  EXPECT_EQ(confirmed_ids(log).size(), 2u);
  for (const auto& p : log.at(25)) {
    double nearest = 1e9;
    for (const auto& t : truth_at(scene, 25)) {
      nearest = std::min(nearest, std::hypot(p.x - t.x, p.y - t.y));
    }
    EXPECT_LT(nearest, 1.5);
  }
}

TEST(MmPf, AStricterTestDeclaresLater) {
  const Scene scene = scene_of(1, 12, 3, 30);
  MmPfConfig lax = config_for(12), strict = lax;
  lax.false_probability = 1e-3, strict.false_probability = 1e-9;
  const auto first = [](const TrackLog& log) {
    const auto points = log.online();
    return points.empty() ? std::int64_t{99} : points.front().frame;
  };
  EXPECT_LT(first(track(scene, lax)), first(track(scene, strict)));
}

TEST(MmPf, EndsATrackWhoseTargetVanishes) {
  const TrackLog log = track(scene_of(1, 16, 2, 15), config_for(16));
  EXPECT_TRUE(std::ranges::any_of(log.online(),
                                  [](const auto& p) { return p.status == TrackStatus::halted; }));
  EXPECT_TRUE(log.at(25).empty());
}

TEST(MmPf, DeclaresLittleInNoise) {
  std::size_t declared = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    declared += confirmed_ids(track(scene_of(0, 10, 0, 0, 40), config_for(10), seed)).size();
  }
  EXPECT_LE(declared, 1u);
}

TEST(MmPf, TakesEmptyAndTinyFrames) {
  MmPf tracker(MmPfConfig{}, Device::serial(), 1);
  TrackLog log;
  tracker.step(Scan{}, log);
  Scan scan;
  scan.whitened = Frame(Image<float>(3, 2));
  tracker.step(scan, log);
  EXPECT_TRUE(log.online().empty());
}

}  // namespace
}  // namespace glint

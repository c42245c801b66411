// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/mm_pf.hpp"

#include <gtest/gtest.h>

#include <map>
#include <utility>
#include <vector>

#include "engine/dim_targets.hpp"

namespace glint {
namespace {

using namespace test;

MmPfConfig config_for(double snr) {
  MmPfConfig c;
  c.psf_sigma = 0.7, c.jitter = 0;
  c.snr_low = snr - 2, c.snr_high = snr + 2;
  c.intensity_walk = 0.03;
  c.birth_particles = 2000;
  c.mask_half_width = 0, c.separation = 2;
  return c;
}

TEST(MmPf, DeclaresTwoTargets) {
  const Scene scene = two_targets(15, 3, 30);
  const TrackLog log = track<MmPf>(scene, config_for(15));
  EXPECT_EQ(confirmed_ids(log).size(), 2u);
  for (const auto& p : log.at(25)) EXPECT_LT(distance_to_truth(scene, p), 1.5);
}

/// Frames from the first declaration to that of the fifth of five targets.
std::int64_t frames_between(std::uint64_t seed) {
  std::vector<ScriptedTarget> five;
  for (int i = 0; i < 5; ++i) five.push_back(target(3, 30, {6 + 7.0 * i, 8, 0.1, 0.6}, 16));
  const TrackLog log = track<MmPf>(scene_of(std::move(five)), config_for(16), seed);
  std::map<std::int64_t, std::int64_t> first;
  for (const auto& p : log.online()) first.emplace(p.track_id, p.frame);
  return first.at(5) - first.at(1);
}

TEST(MmPf, DeclaresEveryTargetThatPassesTheTest) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) EXPECT_LE(frames_between(seed), 2) << seed;
}

TEST(MmPf, AStricterTestDeclaresLater) {
  const Scene scene = one_target(12, 3, 30);
  MmPfConfig lax = config_for(12), strict = lax;
  lax.false_probability = 1e-3, strict.false_probability = 1e-9;
  EXPECT_LT(first_frame(track<MmPf>(scene, lax).online()),
            first_frame(track<MmPf>(scene, strict).online()));
}

// The odds are in proportion to it, and so is what they are compared with.
TEST(MmPf, TheMassOfBirthsDoesNotDelayDeclarations) {
  MmPfConfig many = config_for(12), few = many;
  many.birth_mass = 1e-3, few.birth_mass = 1e-7;
  const Scene scene = one_target(12, 3, 30);
  std::int64_t later = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    later += first_frame(track<MmPf>(scene, few, seed).online()) -
             first_frame(track<MmPf>(scene, many, seed).online());
  }
  EXPECT_NEAR(static_cast<double>(later) / 8, 0, 0.3);
}

TEST(MmPf, EndsATrackWhoseTargetVanishes) {
  const TrackLog log = track<MmPf>(one_target(16, 2, 15), config_for(16));
  EXPECT_TRUE(any_halted(log));
  EXPECT_TRUE(log.at(25).empty());
}

TEST(MmPf, DeclaresLittleInNoise) { EXPECT_LE(declared_in_noise<MmPf>(config_for(10), 40, 5), 1u); }

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

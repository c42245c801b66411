// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/mm_phd.hpp"

#include <gtest/gtest.h>

#include "engine/dim_targets.hpp"

namespace glint {
namespace {

using namespace test;

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

TEST(MmPhd, FollowsTwoTargetsUnderTwoIdentities) {
  const Scene scene = two_targets(15, 3, 30);
  const auto points = confirmed(track<MmPhd>(scene, config_for(15)).revised());
  EXPECT_EQ(ids(points).size(), 2u);
  for (const auto& p : points) EXPECT_LT(distance_to_truth(scene, p), 1.5) << p.frame;
}

std::int64_t first_frame(const Scene& scene, const MmPhdConfig& config, std::uint64_t seed) {
  return test::first_frame(confirmed(track<MmPhd>(scene, config, seed).revised()));
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
  const TrackLog log = track<MmPhd>(one_target(16, 2, 15), config_for(16));
  EXPECT_TRUE(any_halted(log));
  std::int64_t last = -1;
  for (const TrackPoint& p : log.revised()) {
    if (p.status != TrackStatus::halted) last = std::max(last, p.frame);
  }
  EXPECT_EQ(last, 14);  // the last one that shows the target
}

TEST(MmPhd, ConfirmsNothingInNoise) {
  EXPECT_LE(declared_in_noise<MmPhd>(config_for(10), 40, 5), 1u);
}

TEST(MmPhd, TellsATurnFromAStraightLine) {
  Scene scene = scene_of({target(0, 30, {8, 20, 1, 0}, 20)});
  const auto straight = confirmed(track<MmPhd>(scene, config_for(20)).online());
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

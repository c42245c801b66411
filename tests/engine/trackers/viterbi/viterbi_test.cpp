// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/viterbi/viterbi.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "engine/dim_targets.hpp"

namespace glint {
namespace {

using namespace test;

ViterbiConfig config_for(double snr) {
  ViterbiConfig c;
  c.psf_sigma = 0.7;
  c.snr_low = snr - 2, c.snr_high = snr + 2;
  c.speed_max = 2;
  return c;
}

std::map<std::int64_t, std::vector<TrackPoint>> by_track(const std::vector<TrackPoint>& points) {
  std::map<std::int64_t, std::vector<TrackPoint>> tracks;
  for (const TrackPoint& p : points) tracks[p.track_id].push_back(p);
  return tracks;
}

TEST(Viterbi, FollowsEachTargetUnderOneIdentityFromItsBirth) {
  const Scene scene = two_targets(16, 3, 30);
  const auto tracks = by_track(track<Viterbi>(scene, config_for(16)).revised());
  ASSERT_EQ(tracks.size(), 2u);
  for (const auto& [id, points] : tracks) {
    EXPECT_NEAR(static_cast<double>(points.front().frame), 3, 1);
    EXPECT_EQ(points.back().frame, 29);
    for (const TrackPoint& p : points) EXPECT_LT(distance_to_truth(scene, p), 2) << p.frame;
  }
}

TEST(Viterbi, ReportsNothingBeforeItsWindowIsFull) {
  const TrackLog log = track<Viterbi>(one_target(18, 0, 30), config_for(18));
  EXPECT_EQ(log.online().front().frame, 7);
  EXPECT_EQ(log.revised().front().frame, 0);
}

TEST(Viterbi, KnowsTheVelocity) {
  Scene scene = scene_of({target(0, 30, {6, 8, 1.8, 0.6}, 18)});
  scene.interval = 0.5;
  double sum = 0, count = 0;
  for (const TrackPoint& p : track<Viterbi>(scene, config_for(18)).revised()) sum += p.vx, ++count;
  EXPECT_NEAR(sum / count, 1.8, 0.15);
}

TEST(Viterbi, StatesHowSureItIs) {
  Scene scene = scene_of({target(2, 20, {6, 8, 0.8, 0.6}, 18)});
  scene.interval = 0.5;
  const TrackLog log = track<Viterbi>(scene, config_for(18));
  std::int64_t halted = 0;
  for (const TrackPoint& p : log.online()) {
    if (p.status == TrackStatus::halted) {
      EXPECT_EQ(p.existence, 0);
      ++halted;
      continue;
    }
    EXPECT_GT(p.existence, 0.9);
    EXPECT_GE(p.var_x, 1.0 / 12);
    // Over two frames of .5 s, from the cell two before to the newest.
    EXPECT_NEAR(p.cov_x_vx, p.var_x, 1e-9);
    EXPECT_NEAR(p.cov_y_vy, p.var_y, 1e-9);
    EXPECT_GT(p.var_vx, p.var_x);
  }
  EXPECT_EQ(halted, 1);
  // But for the first and the last, a cell has no share in its velocity.
  const auto revised = log.revised();
  EXPECT_EQ(std::ranges::count_if(revised, [](const TrackPoint& p) { return p.cov_x_vx == 0; }),
            static_cast<std::ptrdiff_t>(revised.size()) - 2);
}

TEST(Viterbi, EndsATrackSoonAfterItsTargetHasVanished) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const TrackLog log = track<Viterbi>(one_target(16, 2, 15), config_for(16), seed);
    const auto online = log.online();
    ASSERT_EQ(std::ranges::count(online, TrackStatus::halted, &TrackPoint::status), 1);
    const TrackPoint& halt = online.back();
    EXPECT_EQ(halt.status, TrackStatus::halted);
    EXPECT_EQ(halt.frame, log.revised().back().frame + ViterbiConfig{}.halt_frames);
    EXPECT_NEAR(static_cast<double>(log.revised().back().frame), 14, 1);
  }
}

TEST(Viterbi, HaltsAsConfigured) {
  ViterbiConfig soon = config_for(16), late = soon;
  soon.halt_frames = 2,
  late.halt_frames = 32;  // 6: then the window shows less than 3 of its points
  const auto halted = [](const ViterbiConfig& config) {
    return track<Viterbi>(one_target(16, 2, 15), config).online().back().frame;
  };
  EXPECT_EQ(halted(late) - halted(soon), 4);
}

// Two frames of a bright target exceed the threshold of the whole window.
TEST(Viterbi, WhatABrightTargetLeavesInTheWindowIsNoNewTrack) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const TrackLog log = track<Viterbi>(one_target(22, 2, 15), config_for(22), seed);
    EXPECT_EQ(ids(log.revised()).size(), 1u);
    EXPECT_EQ(ids(log.online()).size(), 1u);
  }
}

TEST(Viterbi, AFlashIsNoTrack) {
  const TrackLog log = track<Viterbi>(one_target(22, 10, 12), config_for(22));
  EXPECT_TRUE(log.online().empty());
  EXPECT_TRUE(log.revised().empty());
}

TEST(Viterbi, DeclaresLittleInNoise) {
  EXPECT_LE(declared_in_noise<Viterbi>(config_for(12), 40, 5), 1u);
}

TEST(Viterbi, AHigherThresholdDeclaresLater) {
  ViterbiConfig lax = config_for(12), strict = lax;
  lax.threshold = 15, strict.threshold = 45;
  const Scene scene = one_target(12, 10, 30);
  EXPECT_LT(first_frame(track<Viterbi>(scene, lax).online()),
            first_frame(track<Viterbi>(scene, strict).online()));
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

// The target is at x = 20 until frame 4. Frames 5 to 7 show a bright spot 3 px to the left and a
// lesser one 3 px to the right; frame 8 tells that the target has gone right, which is too far from
// the left one.
TEST(Viterbi, WhatALaterWindowSaysChangesOnlyPointsThatAreNotSettled) {
  for (const int settled : {1, 2, 3}) {
    ViterbiConfig config = config_for(16);
    config.speed_max = 3, config.acceleration_max = 5, config.settled_frames = settled;
    Viterbi tracker(config, Device::serial(), 1);
    TrackLog log;
    for (int k = 0; k <= 8; ++k) {
      Image<float> image(40, 40);
      if (k < 5) image.view()(20, 15) = 12;
      if (k >= 5 && k < 8) image.view()(17, 15) = 12, image.view()(23, 15) = 11;
      if (k == 8) image.view()(26, 15) = 12;
      Scan scan;
      scan.frame = k, scan.time = k, scan.whitened = Frame(std::move(image));
      tracker.step(scan, log);
    }
    ASSERT_EQ(ids(log.revised()).size(), 1u);
    ASSERT_EQ(log.revised().size(), 9u);
    for (const TrackPoint& p : log.revised()) {
      const auto frame = static_cast<int>(p.frame);
      const int right = frame == 8 ? 26 : 23;
      const bool revised = 8 - frame < settled;
      EXPECT_EQ(p.x, frame < 5 ? 20 : revised ? right : 17) << frame << ", settled " << settled;
    }
  }
}

/// A tracker after frames that are dark but for the pixel (20, 15), which shows `light[k]`.
TrackLog after_light(const std::vector<float>& light) {
  Viterbi tracker(config_for(16), Device::serial(), 1);
  TrackLog log;
  for (std::size_t k = 0; k < light.size(); ++k) {
    Image<float> image(40, 40);
    image.view()(20, 15) = light[k];
    Scan scan;
    scan.frame = static_cast<std::int64_t>(k), scan.time = static_cast<double>(k);
    scan.whitened = Frame(std::move(image));
    tracker.step(scan, log);
  }
  return log;
}

// The track ends at frame 11, four frames after its last point at 7, which is in the window until
// frame 14: until then a path near it is no new track, though it shares but a frame or two with it.
TEST(Viterbi, WhatIsNearAHaltedTrackInTheWindowIsNoNewTrack) {
  std::vector<float> light(20, 30);
  std::fill_n(light.begin() + 8, 4, 0.0F);
  const auto tracks = by_track(after_light(light).online());
  ASSERT_EQ(tracks.size(), 2u);
  EXPECT_EQ(tracks.at(1).back().frame, 11);
  EXPECT_EQ(tracks.at(2).front().frame, 15);
}

TEST(Viterbi, RefusesACommonStretchLongerThanItsWindow) {
  ViterbiConfig config;
  config.window = 4, config.common_frames = 5;
  EXPECT_THROW(Viterbi(config, Device::serial(), 1), ConfigError);
}

/// What a threshold leaves of a target of 12 dB, with a cue on its place at frame 6 or without.
TrackLog with_cue(double threshold, std::span<const Cue> cues) {
  const Scene scene = one_target(12, 0, 8);
  ViterbiConfig config = config_for(12);
  config.threshold = threshold;
  Viterbi tracker(config, Device::tbb(1), 1);
  TrackLog log;
  for (int k = 0; k < scene.frames; ++k) {
    Scan scan = whitened_scan(scene, 1, k);
    if (k == 6) scan.cues = cues;
    tracker.step(scan, log);
    if (k == 7) break;  // the first full window
  }
  return log;
}

// The best path's total lies between two thresholds; a cue of sigma 1 on a pixel of the 1600 raises
// it by ln(1600 / 2 pi) = 5.54, one elsewhere by nothing.
TEST(Viterbi, ACueIsAPriorOfItsFrame) {
  const TruthPoint at = truth_at(one_target(12, 0, 8), 6)[0];
  const Cue there{std::round(at.x), std::round(at.y), 0, 0, 1}, elsewhere{30, 30, 0, 0, 1};
  double most = 0;
  while (!with_cue(most, {}).online().empty()) most += 0.25;
  EXPECT_GT(most, 30);  // the target's
  EXPECT_FALSE(with_cue(most + 3.5, std::span(&there, 1)).online().empty());
  EXPECT_TRUE(with_cue(most + 5.6, std::span(&there, 1)).online().empty());
  EXPECT_TRUE(with_cue(most + 0.25, std::span(&elsewhere, 1)).online().empty());
}

}  // namespace
}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/experiments/calibration.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <set>
#include <stdexcept>
#include <string>

#include "engine/dim_targets.hpp"
#include "glint/engine/trackers/viterbi/viterbi.hpp"
#include "glint/experiments/tracker_setup.hpp"

namespace glint {
namespace {

TEST(Threshold, GoesFromLaxToStrictInSteps) {
  constexpr Threshold kEven{"viterbi", "threshold", 5, 105, 1000};
  EXPECT_EQ(kEven.at(0), 5);
  EXPECT_EQ(kEven.at(254), 30.4);
  EXPECT_EQ(kEven.at(1000), 105);
  constexpr Threshold kGeometric{"mm-pf", "false_probability", 0.1, 1e-12, 110, true};
  EXPECT_EQ(kGeometric.at(0), 0.1);
  EXPECT_EQ(kGeometric.at(10), 0.01);
  EXPECT_EQ(kGeometric.at(1), 0.07943);
  EXPECT_EQ(kGeometric.at(110), 1e-12);
}

TEST(Threshold, EveryValueOfEveryTrackerCanBeSet) {
  for (const Threshold& t : all_thresholds()) {
    for (const int step : {0, t.steps / 2, t.steps}) {
      const TrackerSetup setup{std::string(t.tracker), {{std::string(t.key), t.at(step)}}};
      EXPECT_NO_THROW(setup.make(Device::serial(), 1)) << t.tracker << ' ' << t.at(step);
    }
  }
}

TEST(Threshold, IsFoundByItsTracker) {
  EXPECT_EQ(find_threshold("viterbi").key, "threshold");
  EXPECT_THROW(find_threshold("no-such"), ConfigError);
}

/// 1.28e-1 frames of a megapixel.
CalibrationOptions options_for(double false_tracks) {
  CalibrationOptions options;
  options.noise = {40, 40, 20};
  options.runs = 4;
  options.false_tracks = false_tracks;
  return options;
}

/// Of narrow targets, which noise is easily taken for.
ConfigSection viterbi() {
  return TrackerSetup{"viterbi", {{"psf_sigma", 0.6}, {"speed_max", 3.0}}}.config();
}

Calibration calibrated(double false_tracks, int threads = 1) {
  ConfigSection config = viterbi();
  Workers workers(threads);
  return calibrate(find_threshold("viterbi"), config, options_for(false_tracks), workers);
}

/// The tracks of seeds 1 to 4, counted anew.
std::int64_t tracks_at(double threshold) {
  ViterbiConfig config = viterbi().as<ViterbiConfig>();
  config.threshold = threshold;
  std::size_t tracks = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const TrackLog log = test::track<Viterbi>(test::scene_of({}, 20), config, seed);
    std::set<std::int64_t> all = test::confirmed_ids(log);
    all.merge(test::ids(test::confirmed(log.revised())));
    tracks += all.size();
  }
  return static_cast<std::int64_t>(tracks);
}

TEST(Calibration, FindsTheLeastThresholdThatKeepsTheRate) {
  const Calibration found = calibrated(60);  // at most 7 tracks
  EXPECT_NEAR(found.megapixel_frames, 0.128, 1e-12);
  EXPECT_LE(found.attained.rate, 60);
  EXPECT_GT(found.attained.tracks, 0);
  EXPECT_FALSE(found.at_lax_end);
  EXPECT_EQ(tracks_at(found.value), found.attained.tracks);
  EXPECT_GT(tracks_at(found.value - 0.5), 7);
}

TEST(Calibration, StatesTheRateAndItsError) {
  const FalseTracks f = calibrated(60).attained;
  EXPECT_DOUBLE_EQ(f.rate, static_cast<double>(f.tracks) / 0.128);
  EXPECT_DOUBLE_EQ(f.error, std::sqrt(static_cast<double>(f.tracks)) / 0.128);
}

TEST(Calibration, FewerFalseTracksNeedAHigherThreshold) {
  EXPECT_LT(calibrated(200).value, calibrated(20).value);
}

TEST(Calibration, IsTheSameForAnyNumberOfThreads) {
  const tbb::global_control eight(tbb::global_control::max_allowed_parallelism, 8);
  const Calibration one = calibrated(60, 1);
  for (const int threads : {2, 3}) {
    const Calibration other = calibrated(60, threads);
    EXPECT_EQ(other.value, one.value);
    EXPECT_EQ(other.attained.tracks, one.attained.tracks);
    EXPECT_EQ(other.checked.tracks, one.checked.tracks);
  }
}

TEST(Calibration, ChecksOnTheSeedsThatFollow) {
  const Calibration found = calibrated(60);
  CalibrationOptions options = options_for(1e9);
  options.seed = 5;
  ConfigSection config = viterbi();
  Workers workers(1);
  const Threshold only{"viterbi", "threshold", found.value, found.value, 1};
  EXPECT_EQ(calibrate(only, config, options, workers).attained.tracks, found.checked.tracks);
}

TEST(Calibration, LeavesTheValueInTheConfig) {
  ConfigSection config = viterbi();
  Workers workers(1);
  const Calibration found = calibrate(find_threshold("viterbi"), config, options_for(60), workers);
  EXPECT_EQ(config.as<ViterbiConfig>().threshold, found.value);
}

TEST(Calibration, SaysWhenEvenTheLaxestWillDo) {
  const Calibration found = calibrated(1e9);
  EXPECT_TRUE(found.at_lax_end);
  EXPECT_EQ(found.value, 0);
}

TEST(Calibration, FailsIfNoValueIsStrictEnough) {
  ConfigSection config = viterbi();
  Workers workers(1);
  const Threshold lax{"viterbi", "threshold", 0, 3, 3};
  EXPECT_THROW(calibrate(lax, config, options_for(1e-3), workers), std::runtime_error);
}

TEST(Calibration, FeedsTrackersOfPoints) {
  ConfigSection config =
      TrackerSetup{"imm-pda-ai",
                   {{"confirm_hits", std::int64_t{1}}, {"confirm_window", std::int64_t{1}}}}
          .config();
  Workers workers(1);
  const Calibration found =
      calibrate(find_threshold("imm-pda-ai"), config, options_for(60), workers);
  EXPECT_GT(found.attained.tracks, 0);
  EXPECT_GT(found.value, 2);
}

}  // namespace
}  // namespace glint

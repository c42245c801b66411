// SPDX-License-Identifier: Apache-2.0
// How tracks of h-pmht begin and end, in frames without noise: a target explains what it gives.
#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "glint/engine/scenario/scenario.hpp"
#include "glint/engine/trackers/h_pmht/h_pmht.hpp"

namespace glint {
namespace {

constexpr double kIntensity = 30;

ScriptedTarget target(int birth, int death, const Kinematics& start,
                      double intensity = kIntensity) {
  ScriptedTarget t;
  t.birth = birth, t.death = death, t.intensity = intensity, t.path = fly(start);
  return t;
}

HPmhtConfig noiseless() {
  HPmhtConfig config;
  config.noise_threshold = 0;
  return config;
}

class Film {
 public:
  Film(const HPmhtConfig& config, std::vector<ScriptedTarget> targets)
      : tracker(config, Device::tbb(1), 1) {
    scene_.width = 60, scene_.height = 40, scene_.frames = 30, scene_.noise_sigma = 0;
    scene_.point_spread = PointSpread::of(1);
    scene_.targets = std::move(targets);
  }
  /// Steps until `frames` frames are done.
  void until(int frames) {
    for (; next_ < frames; ++next_) {
      Scan scan;
      scan.frame = next_, scan.time = next_ * scene_.interval;
      scan.whitened = Frame(render(scene_, 1, next_));
      tracker.step(scan, log);
    }
  }
  /// The next frame is this one.
  void skip_to(int frame) { next_ = frame; }
  HPmht tracker;
  TrackLog log;

 private:
  Scene scene_;
  int next_ = 0;
};

/// First and last frame of each track.
struct Extent {
  std::int64_t first, last;
  bool operator==(const Extent&) const = default;
};
std::map<std::int64_t, Extent> extents(const std::vector<TrackPoint>& points) {
  std::map<std::int64_t, Extent> all;
  for (const TrackPoint& p : points) {
    all.try_emplace(p.track_id, Extent{p.frame, p.frame}).first->second.last = p.frame;
  }
  return all;
}
using Extents = std::map<std::int64_t, Extent>;

// Two of three scans dark leave a mean of 10.
TEST(HPmhtLives, ATrackEndsWhenTheMeanOfItsLastScansIsBelowHaltCount) {
  for (const auto& [halt_count, end] : {std::pair{12.0, 11}, {8.0, 12}, {21.0, 10}}) {
    HPmhtConfig config = noiseless();
    config.initiate = false, config.halt_count = halt_count;
    Film film(config, {target(0, 10, {10, 12, 1, 0.5})});
    film.tracker.start(10, 12, 1, 0.5);
    film.until(20);
    EXPECT_EQ(extents(film.log.online()), (Extents{{1, {0, end}}})) << halt_count;
    EXPECT_EQ(film.log.online().back().status, TrackStatus::halted);
    EXPECT_EQ(extents(film.log.revised()), (Extents{{1, {0, 9}}})) << halt_count;
  }
}

TEST(HPmhtLives, ATargetExplainsAllThatItGives) {
  HPmhtConfig config = noiseless();
  config.initiate = false;
  Film film(config, {target(0, 30, {10, 12, 1, 0.5})});
  film.tracker.start(10, 12, 1, 0.5);
  film.until(8);
  EXPECT_NEAR(film.log.at(7)[0].intensity, kIntensity, 0.1 * kIntensity);
  EXPECT_NEAR(film.log.at(7)[0].x, 17, 0.1);
  EXPECT_NEAR(film.log.at(7)[0].y, 15.5, 0.1);
}

// Four frames on, the target is 12 px away: a guess that is a step of 3 px off sees nothing of it.
TEST(HPmhtLives, TracksMoveOnByAsManyFramesAsLieBetweenTwoScans) {
  HPmhtConfig config = noiseless();
  config.initiate = false;
  Film film(config, {target(0, 30, {5, 12, 3, 0})});
  film.tracker.start(5, 12, 3, 0);
  film.until(6);
  film.skip_to(9);
  film.until(10);
  ASSERT_EQ(film.log.at(9).size(), 1u);
  EXPECT_NEAR(film.log.at(9)[0].x, 5 + 3 * 9, 0.1);
  EXPECT_NEAR(film.log.at(9)[0].intensity, kIntensity, 0.1 * kIntensity);
}

// The prior of a candidate is where the two points put it a step before the first, and weighs as
// much as a scan where all of the frame's shots count.
TEST(HPmhtLives, ACandidatesPriorLiesOnTheLineOfItsTwoPoints) {
  HPmhtConfig config = noiseless();
  config.sensor_area = 1e9;
  Film film(config, {target(0, 30, {10, 12, 2, 1})});
  film.until(5);
  const auto points = film.log.revised();
  ASSERT_EQ(points.size(), 5u);
  for (const TrackPoint& p : points) {
    EXPECT_NEAR(p.x, 10 + 2 * static_cast<double>(p.frame), 0.2) << p.frame;
    EXPECT_NEAR(p.y, 12 + static_cast<double>(p.frame), 0.2) << p.frame;
  }
}

TEST(HPmhtLives, ATrackStatesHowSureItIs) {
  Film film(noiseless(), {target(4, 12, {10, 12, 1, 0.5})});
  film.until(20);
  for (const TrackPoint& p : film.log.online()) {
    if (p.frame < 12) {
      EXPECT_GT(p.existence, 0.99) << p.frame;
      EXPECT_EQ(p.cov_xy, 0);  // the axes have nothing to do with each other
      EXPECT_GT(p.var_x, 0);
      EXPECT_GT(p.var_vx, 0);
      EXPECT_GT(p.var_x * p.var_vx, p.cov_x_vx * p.cov_x_vx);
    }
    if (p.status == TrackStatus::halted) {
      EXPECT_LT(p.existence, 0.1);
    }
  }
}

// The dimmer candidates may be, the more noise is among them.
TEST(HPmhtLives, DimmerCandidatesMustExplainMore) {
  HPmhtConfig config;
  EXPECT_EQ(least_confirm_count(config), 3.3);
  config.snr = 9;
  EXPECT_NEAR(least_confirm_count(config), 3.651, 1e-9);
  config.snr = 0;
  EXPECT_EQ(least_confirm_count(config), 4);
  config.intensity = CellIntensity::rpim;
  EXPECT_EQ(least_confirm_count(config), 3.3);
  config.confirm_count = 2;
  EXPECT_EQ(least_confirm_count(config), 2);
}

// 10.6 tracks in 60 frames of 256x256 when confirm_count did not follow snr.
TEST(HPmhtLives, AreFewInNoiseHoweverDimTheTargetsMayBe) {
  HPmhtConfig config;
  config.snr = 6;
  HPmht tracker(config, Device::tbb(2), 1);
  TrackLog log;
  Scene scene;
  scene.width = scene.height = 256, scene.frames = 30;
  for (int k = 0; k < scene.frames; ++k) {
    Scan scan;
    scan.frame = k, scan.time = k, scan.whitened = Frame(render(scene, 3, k));
    tracker.step(scan, log);
  }
  EXPECT_LE(extents(log.online()).size(), 1U);
}

// A pair of frames makes a candidate, which is confirmed at its fifth and traced back to its first.
TEST(HPmhtLives, ACandidateIsConfirmedAtTheLastOfConfirmFrames) {
  Film film(noiseless(), {target(4, 30, {10, 12, 1, 0.5})});
  film.until(20);
  EXPECT_EQ(extents(film.log.online()), (Extents{{1, {8, 19}}}));
  EXPECT_EQ(extents(film.log.revised()), (Extents{{1, {4, 19}}}));
}

TEST(HPmhtLives, ACandidateOfTooLittleMeanIsNotConfirmed) {
  HPmhtConfig config = noiseless();
  config.confirm_count = 1.1 * kIntensity;
  Film film(config, {target(4, 30, {10, 12, 1, 0.5})});
  film.until(20);
  EXPECT_TRUE(film.log.online().empty());
}

TEST(HPmhtLives, ACandidateThatEndsIsNeverReported) {
  HPmhtConfig config = noiseless();
  config.confirm_count = 20;  // three of five scans have a mean of 18
  Film film(config, {target(4, 7, {10, 12, 1, 0.5})});
  film.until(20);
  EXPECT_TRUE(film.log.online().empty());
  EXPECT_TRUE(film.log.revised().empty());
}

TEST(HPmhtLives, TheBrightestCandidatesComeFirst) {
  HPmhtConfig config = noiseless();
  config.candidates_max = 1;
  Film film(config, {target(0, 30, {10, 8, 1, 0.2}, 25), target(0, 30, {10, 20, 1, 0.2}, 35),
                     target(0, 30, {10, 32, 1, 0}, 30)});
  film.until(12);
  EXPECT_EQ(extents(film.log.online()), (Extents{{1, {4, 11}}, {2, {5, 11}}, {3, {6, 11}}}));
  const auto last = film.log.at(11);
  EXPECT_NEAR(last[0].y, 20 + 0.2 * 11, 1);
  EXPECT_NEAR(last[1].y, 32, 1);
  EXPECT_NEAR(last[2].y, 8 + 0.2 * 11, 1);
}

TEST(HPmhtLives, NoCandidateComesWithinSeparationOfALivingTrack) {
  for (const auto& [separation, tracks] : {std::pair{4.0, 2U}, {10.0, 1U}}) {
    HPmhtConfig config = noiseless();
    config.separation = separation;
    Film film(config, {target(0, 30, {10, 10, 1, 0}, 30), target(6, 30, {16, 18, 1, 0}, 40)});
    film.until(16);
    EXPECT_EQ(extents(film.log.online()).size(), tracks) << separation;
  }
}

TEST(HPmhtLives, OfTwoTracksOfOneTargetTheYoungerEnds) {
  HPmhtConfig config = noiseless();
  config.initiate = false;
  Film film(config, {target(0, 30, {10, 12, 1, 0.5})});
  film.tracker.start(10, 12, 1, 0.5);
  film.tracker.start(11.5, 12, 1, 0.5);
  film.until(10);
  EXPECT_EQ(extents(film.log.online()), (Extents{{1, {0, 9}}, {2, {0, 1}}}));
  EXPECT_EQ(film.log.at(1)[1].status, TrackStatus::halted);
}

TEST(HPmhtLives, OfTwoOfOneTargetACandidateEndsBeforeAnyTrack) {
  Film film(noiseless(), {target(0, 30, {10, 12, 1, 0.5})});
  film.until(2);  // the candidate of the first two frames is the older
  film.tracker.start(12, 13, 1, 0.5);
  film.until(12);
  EXPECT_EQ(extents(film.log.online()), (Extents{{1, {2, 11}}}));
}

// At frame 10 they are a pixel apart; over the batch 6 px on average.
TEST(HPmhtLives, TwoThatAreNearForAMomentBothLive) {
  HPmhtConfig config = noiseless();
  config.initiate = false;
  Film film(config, {target(0, 30, {10, 10, 2, 1}), target(0, 30, {50, 11, -2, 1})});
  film.tracker.start(10, 10, 2, 1);
  film.tracker.start(50, 11, -2, 1);
  film.until(16);
  EXPECT_EQ(extents(film.log.online()), (Extents{{1, {0, 15}}, {2, {0, 15}}}));
}

}  // namespace
}  // namespace glint

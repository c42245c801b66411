// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/pmht/pmht.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <vector>

#include "glint/engine/scenario/point_sensor.hpp"
#include "glint/engine/scenario/scenes.hpp"

namespace glint {
namespace {

/// A tracker, and scans of nothing but points.
class PointRun {
 public:
  explicit PointRun(const PmhtConfig& config = {}) : tracker(config, Device::serial(), 1) {}
  void step(std::int64_t frame, double time, const std::vector<PointMeasurement>& points) {
    Scan scan;
    scan.frame = frame, scan.time = time, scan.points = points;
    tracker.step(scan, log);
  }
  void step(std::int64_t frame, const std::vector<PointMeasurement>& points) {
    step(frame, static_cast<double>(frame), points);
  }
  std::vector<TrackPoint> at(std::int64_t frame) const { return log.at(frame); }

  Pmht tracker;
  TrackLog log;
};

PointMeasurement straight(std::int64_t frame, double y = 50) {
  return {20 + 3 * static_cast<double>(frame), y + static_cast<double>(frame), 8};
}

PmhtConfig told() {
  PmhtConfig config;
  config.initiate = false;
  config.clutter_density = 1e-4;
  return config;
}

TEST(Pmht, FollowsATargetThatItIsStartedOn) {
  PointRun run(told());
  run.tracker.start(20, 50, 3, 1);
  for (int frame = 0; frame < 12; ++frame) {
    run.step(frame, {straight(frame)});
    ASSERT_EQ(run.at(frame).size(), 1u);
    const TrackPoint p = run.at(frame)[0];
    EXPECT_EQ(p.status, TrackStatus::confirmed);
    EXPECT_NEAR(p.x, 20 + 3 * frame, 1e-6);
    EXPECT_NEAR(p.y, 50 + frame, 1e-6);
    EXPECT_NEAR(p.vx, 3, 1e-6);
    EXPECT_NEAR(p.mode_probability[0] + p.mode_probability[1], 1, 1e-12);
    if (frame == 0) continue;
    ASSERT_EQ(run.tracker.expected().size(), 1u);
    EXPECT_EQ(run.tracker.expected()[0].track_id, p.track_id);
    EXPECT_NEAR(run.tracker.expected()[0].x, 20 + 3 * frame, 1e-6);
    EXPECT_EQ(p.intensity, 8);
  }
  EXPECT_EQ(run.log.mode_names(), (std::vector<std::string>{"ca", "singer"}));
}

TEST(Pmht, TheStartIsThatOfThePaper) {
  PointRun run(told());
  run.tracker.start(20, 50, 3, 1);
  run.step(0, {});
  EXPECT_EQ(run.at(0)[0].var_x, 9);
  // One step on: [[9,9,0],[9,18,0],[0,0,4]] by F and Q, models nearly alike in position.
  run.step(1, {});
  EXPECT_NEAR(run.at(1)[0].var_x, 9 + 2 * 9 + 18 + 4.0 / 4, 0.5);
}

TEST(Pmht, MissingScansAndScansWithoutPointsCoast) {
  for (const bool empty : {false, true}) {
    PointRun run(told());
    run.tracker.start(20, 50, 3, 1);
    for (int frame = 0; frame < 20; ++frame) {
      const bool gap = frame >= 8 && frame < 11;
      if (gap && !empty) continue;
      run.step(frame, gap ? std::vector<PointMeasurement>{} : std::vector{straight(frame)});
    }
    ASSERT_EQ(run.at(19).size(), 1u);
    EXPECT_NEAR(run.at(19)[0].x, 20 + 3 * 19, 1e-4);
    EXPECT_GT(run.at(11)[0].var_x, run.at(19)[0].var_x);
    if (empty) {
      EXPECT_NEAR(run.at(10)[0].x, 20 + 3 * 10, 1e-4);
      EXPECT_GT(run.at(10)[0].var_x, run.at(8)[0].var_x);
    } else {
      EXPECT_TRUE(run.at(10).empty());
    }
  }
}

TEST(Pmht, TimeStampsMayBeIrregular) {
  PmhtConfig config = told();
  config.clock = TimeUnit::seconds;
  PointRun run(config);
  run.tracker.start(20, 50, 30, 10);
  double time = 0;
  for (int frame = 0; frame < 20; ++frame) {
    run.step(frame, time, {{20 + 30 * time, 50 + 10 * time, 8}});
    const TrackPoint p = run.at(frame)[0];
    EXPECT_NEAR(p.x, 20 + 30 * time, 1e-4);
    EXPECT_NEAR(p.vx, 30, 1e-3);
    time += frame % 3 == 0 ? 0.31 : 0.07;
  }
}

TEST(Pmht, TheOrderOfPointsDoesNotMatter) {
  PointRun a(told()), b(told());
  for (PointRun* run : {&a, &b}) {
    run->tracker.start(20, 50, 3, 1), run->tracker.start(20, 60, 3, 1);
    run->step(0, {});
  }
  std::vector<PointMeasurement> points{straight(1), straight(1, 60), {25, 53, 8}, {90, 9, 8}};
  a.step(1, points);
  std::reverse(points.begin(), points.end());
  b.step(1, points);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(a.at(1)[i].x, b.at(1)[i].x, 1e-12);
    EXPECT_NEAR(a.at(1)[i].y, b.at(1)[i].y, 1e-12);
  }
}

TEST(Pmht, BadPointsAreLeftOut) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  PointRun run, clean;
  for (int frame = 0; frame < 8; ++frame) {
    run.step(frame, {{kNan, 5, 9}, straight(frame), {5, kNan, 9}});
    clean.step(frame, {straight(frame)});
  }
  EXPECT_EQ(run.log.text(), clean.log.text());
  EXPECT_FALSE(run.at(7).empty());
}

TEST(Pmht, StartsConfirmsAndEndsATrackByItself) {
  PointRun run;
  for (int frame = 0; frame < 25; ++frame) {
    const bool there = frame >= 3 && frame < 15;
    run.step(frame, there ? std::vector{straight(frame)} : std::vector<PointMeasurement>{});
  }
  EXPECT_TRUE(run.at(3).empty());
  ASSERT_EQ(run.at(4).size(), 1u);
  EXPECT_EQ(run.at(4)[0].status, TrackStatus::tentative);
  EXPECT_NEAR(run.at(4)[0].vx, 3, 1e-6);
  EXPECT_EQ(run.at(8)[0].status, TrackStatus::confirmed);
  EXPECT_GT(run.at(8)[0].existence, 0.95);
  std::int64_t halted = -1;
  for (const TrackPoint& p : run.log.online()) {
    if (p.status == TrackStatus::halted) halted = p.frame;
  }
  EXPECT_GE(halted, 15);
  EXPECT_LE(halted, 19);
  const auto revised = run.log.revised();
  EXPECT_EQ(revised.back().frame, 14);  // what came after the last point is taken back
  EXPECT_EQ(revised.front().status, TrackStatus::confirmed);
}

TEST(Pmht, DimPointsStartNothingAndUnknownOnesMay) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const double amplitude : {2.0, kNan}) {
    PointRun run;
    for (int frame = 0; frame < 8; ++frame) {
      PointMeasurement p = straight(frame);
      p.amplitude = amplitude;
      run.step(frame, {p});
    }
    EXPECT_EQ(run.at(7).empty(), amplitude == 2);
  }
}

TEST(Pmht, TwoTracksOnOneTargetBecomeOne) {
  PointRun run;
  run.tracker.start(20, 50, 3, 1), run.tracker.start(21, 50, 3, 1);
  for (int frame = 0; frame < 20; ++frame) run.step(frame, {straight(frame)});
  EXPECT_EQ(run.at(5).size(), 2u);
  ASSERT_EQ(run.at(19).size(), 1u);
  EXPECT_EQ(run.at(19)[0].track_id, 1);
}

TEST(Pmht, FindsTheTargetsOfAClipInClutterAndLittleElse) {
  PmhtClipScene clip;
  clip.clip = "bs49";
  const Scene scene = make_scene(clip);
  PointSensor sensor;
  sensor.clutter = PointSensor::clutter_of(scene, 0.01), sensor.clutter_from = 0;
  PointRun run;
  for (int frame = 0; frame < scene.frames; ++frame) {
    run.step(frame, points_at(scene, sensor, 4, frame));
  }
  int near = 0, all = 0;
  std::set<std::int64_t> ids;
  for (int frame = 10; frame < scene.frames; ++frame) {
    for (const TrackPoint& p : run.at(frame)) {
      if (p.status == TrackStatus::confirmed) ids.insert(p.track_id);
    }
    for (const TruthPoint& t : truth_at(scene, frame)) {
      ++all;
      near += std::ranges::any_of(run.at(frame), [&](const TrackPoint& p) {
        return p.status == TrackStatus::confirmed && std::hypot(p.x - t.x, p.y - t.y) < 5;
      });
    }
  }
  EXPECT_GE(near, all * 9 / 10);
  EXPECT_LE(ids.size(), 6u);
}

TEST(Pmht, ANewTargetMayGainItsLargestSpeedInTenSteps) {
  PmhtConfig config;
  config.motion = "ca", config.speed_max = 30;
  const Imm bank = pmht_bank(config, {{1, 2}, {3, 4}, 0.5});
  const auto& belief = std::get<Mode<WienerAcceleration>>(bank.modes()[0]).belief;
  EXPECT_NEAR(belief.covariance(2, 2), 6 * 6, 1e-12);  // [px^2/time^4]
  EXPECT_NEAR(belief.covariance(5, 5), 6 * 6, 1e-12);
}

TEST(Pmht, BanksAreWhatTheirNamesSay) {
  PmhtConfig config;
  EXPECT_EQ(pmht_mode_names(PmhtHomotheticConfig{}), (std::vector<std::string>{"ca", "ca-agile"}));
  EXPECT_EQ(pmht_mode_names(PmhtCaConfig{}), std::vector<std::string>{"ca"});
  config.motion = "cv+ca+singer";
  const Imm bank = pmht_bank(config, {{1, 2}, {3, 4}, 0.5});
  EXPECT_EQ(bank.modes().size(), 3u);
  const Gaussian<4> state = bank.combined();
  EXPECT_EQ(state.mean, Eigen::Vector4d(1, 3, 2, 4));
  EXPECT_NEAR(state.covariance(0, 1), 9 / 0.5, 1e-12);
  EXPECT_NEAR(state.covariance(1, 1), 18 / 0.25, 1e-12);
  config.life.confirm_hits = 9, config.life.confirm_window = 5;
  EXPECT_THROW(Pmht(config, Device::serial(), 1), ConfigError);
}

// (0.05 x 0.99) / (0.01 + 0.05 x 0.99): the target survives with .99 and is missed with .05.
TEST(Pmht, AMissLowersExistenceByBayesRule) {
  PointRun run(told());
  run.tracker.start(20, 50, 3, 1);
  run.step(0, {straight(0)});
  run.step(1, {});
  EXPECT_NEAR(run.at(1)[0].existence, 0.0495 / 0.0595, 1e-12);
}

// Nearer than `separation` for some of every eight scans, ten or more in all; merge_scans is 8.
TEST(Pmht, TwoThatAreNearNowAndThenStayTwo) {
  PmhtConfig config = told();
  config.measurement_variance = 1, config.gate = 8, config.separation = 20;
  PointRun run(config);
  run.tracker.start(20, 50, 3, 0), run.tracker.start(20, 74, 3, -2);
  constexpr std::array kApart{24, 22, 20, 18, 18, 20, 22, 24};
  for (int frame = 0; frame < 40; ++frame) {
    const float x = 20 + 3 * static_cast<float>(frame);
    const auto apart = static_cast<float>(kApart[static_cast<std::size_t>(frame % 8)]);
    run.step(frame, {{x, 50, 8}, {x, 50 + apart, 8}});
  }
  EXPECT_EQ(run.at(39).size(), 2u);
}

}  // namespace
}  // namespace glint

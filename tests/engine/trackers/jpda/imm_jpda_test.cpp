// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/jpda/imm_jpda.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace glint {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Plays scans of points to a tracker.
class Player {
 public:
  explicit Player(const ImmJpdaConfig& config) : tracker(config, Device::serial(), 1) {}
  void scan(double time, const std::vector<PointMeasurement>& points) {
    Scan scan;
    scan.frame = frame++, scan.time = time, scan.points = points;
    tracker.step(scan, log);
  }
  std::vector<TrackPoint> now() const { return log.at(frame - 1); }

  ImmJpda tracker;
  TrackLog log;
  std::int64_t frame = 0;
};

PointMeasurement at(double x, double y) { return {x, y, 10}; }

ImmJpdaConfig known_targets() {
  ImmJpdaConfig config;
  config.initiate = false, config.clutter_density = 1e-4;
  config.life.halt_misses = 0, config.life.halt_existence = 0, config.merge_scans = 0;
  return config;
}

struct Windows {
  const char* name;
  int window;
  WindowReading reading;
};
class ImmJpdaOf : public testing::TestWithParam<Windows> {
 protected:
  static ImmJpdaConfig windowed(ImmJpdaConfig config) {
    config.window = GetParam().window, config.reading = GetParam().reading;
    return config;
  }
};
INSTANTIATE_TEST_SUITE_P(Windows, ImmJpdaOf,
                         testing::Values(Windows{"Single", 1, WindowReading::best},
                                         Windows{"TwoRestart", 2, WindowReading::restart},
                                         Windows{"TwoSliding", 2, WindowReading::sliding},
                                         Windows{"TwoBest", 2, WindowReading::best},
                                         Windows{"ThreeBest", 3, WindowReading::best},
                                         Windows{"ThreeRestart", 3, WindowReading::restart}),
                         [](const auto& of) { return of.param.name; });

TEST_P(ImmJpdaOf, FollowsCrossingTargetsThroughClutter) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> noise;
    std::uniform_real_distribution<double> uniform(0, 100);
    Player player(windowed(known_targets()));
    player.tracker.start(10, 40, 2, 0.5), player.tracker.start(10, 60, 2, -0.5);
    for (int k = 0; k < 40; ++k) {
      std::vector<PointMeasurement> points;
      const double x = 10 + 2 * k, up = 40 + 0.5 * k, down = 60 - 0.5 * k;
      for (const double y : {up, down}) {
        if (uniform(random) < 90) points.push_back(at(x + noise(random), y + noise(random)));
      }
      for (int c = 0; c < 4; ++c) points.push_back(at(uniform(random), uniform(random)));
      player.scan(k, points);
      const auto tracks = player.now();
      ASSERT_EQ(tracks.size(), 2u);
      EXPECT_LT(std::hypot(tracks[0].x - x, tracks[0].y - up), 5) << seed << " " << k;
      EXPECT_LT(std::hypot(tracks[1].x - x, tracks[1].y - down), 5) << seed << " " << k;
    }
  }
}

TEST_P(ImmJpdaOf, ErrorsAreAsLargeAsTheCovarianceSays) {
  std::mt19937 random(5);
  std::normal_distribution<double> noise;
  double squares = 0;
  int count = 0;
  for (int run = 0; run < 30; ++run) {
    Player player(windowed(known_targets()));
    player.tracker.start(noise(random), noise(random), 1 + 0.1 * noise(random), 0);
    for (int k = 0; k < 20; ++k) {
      player.scan(k, {at(k + noise(random), noise(random))});
      if (k < 5) continue;
      const TrackPoint track = player.now().front();
      squares += (track.x - k) * (track.x - k) / track.var_x + track.y * track.y / track.var_y;
      count += 2;
    }
  }
  EXPECT_GT(squares / count, 0.6);
  EXPECT_LT(squares / count, 1.2);
}

TEST_P(ImmJpdaOf, StartsConfirmsAndEndsByItself) {
  ImmJpdaConfig config = windowed({});
  config.clutter_density = 1e-4;
  Player player(config);
  for (int k = 0; k < 10; ++k) player.scan(k, {at(10 + k, 20), at(50, 60 + 2 * k), at(90, 5)});
  auto tracks = player.now();
  ASSERT_EQ(tracks.size(), 3u);
  for (const TrackPoint& track : tracks) {
    EXPECT_EQ(track.status, TrackStatus::confirmed);
    EXPECT_GT(track.existence, 0.95);
  }
  const auto third = player.log.at(2);
  EXPECT_TRUE(std::ranges::all_of(
      third, [](const TrackPoint& t) { return t.status == TrackStatus::confirmed; }));
  for (int k = 10; k < 20; ++k) player.scan(k, {at(10 + k, 20)});
  tracks = player.now();
  ASSERT_EQ(tracks.size(), 1u);
  EXPECT_NEAR(tracks[0].x, 29, 0.5);
  EXPECT_NEAR(tracks[0].vx, 1, 0.1);
}

TEST_P(ImmJpdaOf, MissingScansCoast) {
  Player player(windowed(known_targets()));
  player.tracker.start(0, 0, 1, 2);
  for (int k = 0; k < 10; ++k) player.scan(k, {at(k, 2 * k)});
  const double before = player.now()[0].var_x;
  for (int k = 10; k < 14; ++k) player.scan(k, {});
  const TrackPoint track = player.now()[0];
  EXPECT_NEAR(track.x, 13, 0.3);
  EXPECT_NEAR(track.y, 26, 0.3);
  EXPECT_GT(track.var_x, before);
}

TEST_P(ImmJpdaOf, TimeStampsNeedNotBeRegular) {
  ImmJpdaConfig config = windowed(known_targets());
  config.clock = TimeUnit::seconds;
  Player player(config);
  player.tracker.start(0, 0, 3, 0);
  double time = 0;
  for (const double step : {0.0, 0.1, 2.5, 0.0, 1.0, 4.0, 0.3, 2.0, 1.7}) {
    time += step;
    player.scan(time, {at(3 * time, 0)});
  }
  EXPECT_NEAR(player.now()[0].x, 3 * time, 0.1);
  EXPECT_NEAR(player.now()[0].vx, 3, 0.1);
}

TEST_P(ImmJpdaOf, PointsThatAreNoPlaceAreIgnored) {
  Player with(windowed(known_targets())), without(windowed(known_targets()));
  for (Player* player : {&with, &without}) player->tracker.start(0, 0, 1, 0);
  for (int k = 0; k < 6; ++k) {
    with.scan(k, {{kNan, 1, 1}, at(k, 0), {2, std::numeric_limits<double>::infinity(), 1}});
    without.scan(k, {at(k, 0)});
  }
  EXPECT_EQ(with.log.text(), without.log.text());
}

TEST_P(ImmJpdaOf, TheOrderOfPointsDoesNotMatter) {
  Player one(windowed(known_targets())), other(windowed(known_targets()));
  for (Player* player : {&one, &other}) {
    player->tracker.start(0, 0, 1, 0), player->tracker.start(0, 4, 1, 0);
  }
  for (int k = 0; k < 12; ++k) {
    std::vector<PointMeasurement> points{at(k, 0.3), at(k + 1, 2), at(k, 4)};
    one.scan(k, points);
    std::ranges::reverse(points);
    other.scan(k, points);
  }
  for (std::size_t t = 0; t < 2; ++t) {
    EXPECT_NEAR(one.now()[t].y, other.now()[t].y, 1e-9);
    EXPECT_NEAR(one.now()[t].var_y, other.now()[t].var_y, 1e-9);
  }
}

// A window of one scan starts anew from the last estimate, whichever way it is read.
TEST(ImmJpda, AKnownTargetIsAsUncertainAsTold) {
  ImmJpdaConfig config = known_targets();
  config.position_sd = 2, config.velocity_sd = 3;
  Player player(config);
  player.tracker.start(5, 7, 1, 0);
  player.scan(0, {});
  EXPECT_NEAR(player.now()[0].var_x, 4, 1e-12);
  player.scan(1, {});
  EXPECT_NEAR(player.now()[0].x, 6, 1e-12);
  EXPECT_NEAR(player.now()[0].var_x, 4 + 9, 0.1);  // and process noise
  EXPECT_NEAR(player.now()[0].cov_xy, 0, 1e-12);
}

// At scan 3 the tentative track at x = 6 has the confirmed one's point within its gate.
TEST(ImmJpda, ATentativeTrackGetsNoPointThatAConfirmedOneHas) {
  ImmJpdaConfig config;
  config.clutter_density = 1e-4, config.separation = 0.01;
  Player player(config);
  player.tracker.start(0, 0, 0, 0);
  player.scan(0, {at(0, 0)});
  for (int k = 1; k < 3; ++k) player.scan(k, {at(0, 0), at(6, 0)});
  ASSERT_EQ(player.now().size(), 2u);
  EXPECT_EQ(player.now()[1].status, TrackStatus::tentative);
  player.scan(3, {at(0, 0)});
  ASSERT_EQ(player.now().size(), 2u);
  EXPECT_NEAR(player.now()[1].x, 6, 1e-9);
}

TEST(ImmJpda, AWindowOfOneScanHasOneReading) {
  ImmJpdaConfig config = known_targets();
  config.reading = WindowReading::restart;
  Player restart(config);
  config.reading = WindowReading::sliding;
  Player sliding(config);
  for (Player* player : {&restart, &sliding}) {
    player->tracker.start(0, 0, 1, 0), player->tracker.start(0, 3, 1, 0);
    for (int k = 0; k < 10; ++k) player->scan(k, {at(k, 0.5), at(k, 2)});
  }
  for (std::size_t t = 0; t < 2; ++t) {
    EXPECT_NEAR(restart.now()[t].y, sliding.now()[t].y, 1e-9);
    EXPECT_NEAR(restart.now()[t].var_y, sliding.now()[t].var_y, 1e-9);
  }
}

// Once two targets were one point, a window that keeps both labels gives their mean for ever.
TEST(ImmJpda, TheBestPermutationKeepsTargetsApartThatWereOnePoint) {
  const auto apart = [](WindowReading reading) {
    std::mt19937 random(2);
    std::normal_distribution<double> noise(0, 0.5);
    ImmJpdaConfig config = known_targets();
    config.window = 2, config.reading = reading;
    Player player(config);
    player.tracker.start(0, 0, 1, 0), player.tracker.start(0, 6, 1, 0);
    for (int k = 0; k < 40; ++k) {
      std::vector<PointMeasurement> points{at(k + noise(random), 6 + noise(random))};
      if (k < 5 || k > 15) points.push_back(at(k + noise(random), noise(random)));
      player.scan(k, points);
    }
    const auto tracks = player.now();
    return std::abs(tracks[0].y - tracks[1].y);
  };
  EXPECT_NEAR(apart(WindowReading::best), 6, 1);
}

TEST(ImmJpda, ModelsTellAManoeuvre) {
  ImmJpdaConfig config = known_targets();
  Player player(config);
  player.tracker.start(0, 0, 2, 0);
  double x = 0, y = 0;
  double straight = 0, turning = 0;
  for (int k = 0; k < 40; ++k) {
    const double heading = k < 20 ? 0 : 0.15 * (k - 20);
    x += 2 * std::cos(heading), y += 2 * std::sin(heading);
    player.scan(k, {at(x, y)});
    if (k == 19) straight = player.now()[0].mode_probability[1];
    if (k == 32) turning = player.now()[0].mode_probability[1];
  }
  EXPECT_LT(straight, 0.3);
  EXPECT_GT(turning, 0.5);
}

TEST(ImmJpda, EveryMotionFollowsAStraightLine) {
  for (const char* motion : {"ncv", "ncv+ncv", "ncv+wpa", "ncv+wpa+wpa"}) {
    ImmJpdaConfig config = known_targets();
    config.motion = motion;
    Player player(config);
    player.tracker.start(0, 0, 2, 1);
    for (int k = 0; k < 15; ++k) player.scan(k, {at(2 * k, k)});
    EXPECT_NEAR(player.now()[0].x, 28, 0.2) << motion;
    EXPECT_NEAR(player.now()[0].vy, 1, 0.1) << motion;
    EXPECT_EQ(player.log.mode_names().size(), player.now()[0].mode_probability.size());
  }
}

TEST(ImmJpda, TellsHowItAssociated) {
  ImmJpdaConfig config = known_targets();
  Player player(config);
  for (int t = 0; t < 30; ++t) player.tracker.start(t, 0, 0, 0);
  std::vector<PointMeasurement> points;
  for (int p = 0; p < 60; ++p) points.push_back(at(0.5 * p, 0.1 * p));
  for (int k = 0; k < 3; ++k) player.scan(k, points);
  const auto notes = player.tracker.notes();
  EXPECT_TRUE(std::ranges::any_of(notes, [](const std::string& note) {
    return note.find("belief propagation in 2 of") != std::string::npos;
  })) << notes.back();
}

TEST(ImmJpda, AWindowMustHoldItsHits) {
  ImmJpdaConfig config;
  config.life.confirm_hits = 5, config.life.confirm_window = 4;
  EXPECT_THROW(ImmJpda(config, Device::serial(), 1), ConfigError);
}

}  // namespace
}  // namespace glint

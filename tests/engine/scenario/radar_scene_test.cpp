// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/scenario/radar_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "glint/engine/scenario/radar_scenes.hpp"
#include "glint/engine/scenario/scenario.hpp"

namespace glint {
namespace {

/// Every aircraft once a scan, where it is.
RadarAircraftScene exact_aircraft() {
  RadarAircraftScene config;
  config.range_sd = config.azimuth_sd = config.elevation_sd = 0;
  config.detection = 1, config.clutter = 0;
  return config;
}

MergingBoatsScene exact_boats() {
  MergingBoatsScene config;
  config.sd = 0, config.detection = 1;
  return config;
}

// P-JPDA section 5: speed 331 m/s, half a circle of radius speed / .32 in 10 s.
TEST(RadarAircraft, FlyThePapersTurns) {
  const RadarScene scene = make_scene(RadarAircraftScene{});
  const double speed = std::hypot(140, 299.9), radius = speed / 0.32;
  EXPECT_LT((place_at(scene, 0, 0) - Eigen::Vector3d(10500, 1740, 40)).norm(), 1e-9);
  const Eigen::Vector3d before = place_at(scene, 0, 15), after = place_at(scene, 0, 25);
  EXPECT_LT((before - Eigen::Vector3d(8400, 1740 + 15 * 299.9, 40)).norm(), 1e-9);
  // To the right: the centre lies across the velocity, clockwise from it.
  const Eigen::Vector3d centre = before + radius / speed * Eigen::Vector3d(299.9, 140, 0);
  for (int scan = 15; scan <= 25; ++scan) {
    EXPECT_NEAR((place_at(scene, 0, scan) - centre).norm(), radius, 1e-6) << scan;
    const TruthPoint truth = truth_at(scene, scan)[0];
    EXPECT_NEAR(std::hypot(truth.vx, truth.vy), speed, 1e-9) << scan;
  }
  EXPECT_NEAR((after - before).norm(), 2 * radius * std::sin(1.6), 1e-6);
  const double heading = std::atan2(299.9, -140) - 3.2;
  const Eigen::Vector3d on(speed * std::cos(heading), speed * std::sin(heading), 0);
  EXPECT_LT((place_at(scene, 0, 35) - after - 10 * on).norm(), 1e-6);
  // The second turns the other way, the third not at all.
  EXPECT_NEAR(place_at(scene, 1, 25).x(), 9800 - 299 / 0.32 * (1 - std::cos(3.2)), 1e-6);
  EXPECT_LT((place_at(scene, 2, 35) - Eigen::Vector3d(9200, 1740 + 35 * 299, 40)).norm(), 1e-9);
}

TEST(RadarAircraft, AreMeasuredFromWhereTheRadarStands) {
  RadarAircraftScene config = exact_aircraft();
  config.sensor_x = 9200, config.sensor_y = 1710;
  const std::vector<Eigen::Vector3d> points = points_at(make_scene(config), 1, 0);
  ASSERT_EQ(points.size(), 3u);  // by range: the third, the second, the first
  EXPECT_LT((points[0] - Eigen::Vector3d(50, std::acos(0), std::atan2(40, 30))).norm(), 1e-9);
  EXPECT_NEAR(points[1].x(), std::sqrt(600. * 600 + 250 * 250 + 40 * 40), 1e-9);
  EXPECT_NEAR(points[2].y(), std::atan2(30, 1300), 1e-12);
}

// Azimuths jump from pi to -pi between targets that are seen from the east.
TEST(RadarAircraft, FalsePointsLieAroundTheTargetsWhereverTheRadarStands) {
  for (const double x : {-20000.0, 40000.0, 9200.0}) {
    RadarAircraftScene config = exact_aircraft();
    config.clutter = 0.1, config.sensor_x = x, config.sensor_y = 1710;
    const RadarScene scene = make_scene(config);
    double points = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      for (const Eigen::Vector3d& point : points_at(scene, seed, 0)) {
        EXPECT_GE(point.x(), 0) << x;
        EXPECT_LE(std::abs(point.y()), std::numbers::pi) << x;
        ++points;
      }
    }
    if (x != 9200) {
      EXPECT_LT(points / 20, 100) << x;  // three targets, and a box of some degrees
    }
  }
}

TEST(RadarAircraft, AreMeasuredAsWellAsTheRadarIs) {
  RadarAircraftScene config = exact_aircraft();
  const RadarScene exact = make_scene(config);
  config.range_sd = 20, config.azimuth_sd = 0.007, config.elevation_sd = 0.002;
  const RadarScene scene = make_scene(config);
  const std::vector<Eigen::Vector3d> want = points_at(exact, 1, 0);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  constexpr int kSeeds = 2000;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const std::vector<Eigen::Vector3d> points = points_at(scene, seed, 0);
    ASSERT_EQ(points.size(), 3u);
    for (std::size_t t = 0; t < 3; ++t) {  // 600 m apart in range
      const Eigen::Vector3d error = (points[t] - want[t]).cwiseQuotient(scene.radar.sd);
      sum += error, squares += error * error.transpose();
    }
  }
  const double n = 3.0 * kSeeds;
  EXPECT_LT((sum / n).cwiseAbs().maxCoeff(), 4 / std::sqrt(n));
  EXPECT_LT((squares / n - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(),
            4 * std::sqrt(2 / n));
}

TEST(RadarAircraft, AreSeenAsOftenAsTheRadarDetects) {
  RadarAircraftScene config = exact_aircraft();
  config.detection = 0.7;
  const RadarScene scene = make_scene(config);
  double seen = 0;
  constexpr int kSeeds = 2000;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    seen += static_cast<double>(points_at(scene, seed, 3).size());
  }
  const double n = 3.0 * kSeeds;
  EXPECT_NEAR(seen / n, 0.7, 4 * std::sqrt(0.21 / n));
}

/// False points alone: their number is Poisson, and they lie all over the box.
void expect_clutter(RadarScene scene, const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                    double expected) {
  scene.radar.detection = 0;
  double count = 0, squares = 0;
  Eigen::Vector3d share = Eigen::Vector3d::Zero();
  constexpr int kSeeds = 2000;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const std::vector<Eigen::Vector3d> points = points_at(scene, seed, 0);
    const auto n = static_cast<double>(points.size());
    count += n, squares += n * n;
    for (const Eigen::Vector3d& p : points) {
      EXPECT_TRUE((p.array() >= low.array() && p.array() <= high.array()).all()) << p.transpose();
      share += p - low;
    }
  }
  const double mean = count / kSeeds;
  EXPECT_NEAR(mean, expected, 4 * std::sqrt(expected / kSeeds));
  // The variance of a Poisson number is its mean; that of the estimate, 2 mean^2 + mean over n.
  EXPECT_NEAR(squares / kSeeds - mean * mean, expected,
              4 * std::sqrt((2 * expected + 1) * expected / kSeeds));
  const double off = 4 / std::sqrt(12 * count);
  for (int axis = 0; axis < 3; ++axis) {
    if (high(axis) == low(axis)) continue;
    EXPECT_NEAR(share(axis) / count / (high(axis) - low(axis)), 0.5, off) << axis;
  }
}

TEST(RadarClutter, IsPoissonInTheBoxAboutTheAircraft) {
  const RadarScene scene = make_scene(RadarAircraftScene{});
  const Eigen::Vector3d margin(1500, 0.15, 0.05);
  const Eigen::Vector3d far(std::sqrt(10500. * 10500 + 1740 * 1740 + 40 * 40),
                            std::atan2(1960, 9800), std::atan2(40, std::hypot(9200, 1740)));
  const Eigen::Vector3d near(std::sqrt(9200. * 9200 + 1740 * 1740 + 40 * 40),
                             std::atan2(1740, 10500), std::atan2(40, std::hypot(10500, 1740)));
  const Eigen::Vector3d low = near - margin, high = far + margin;
  expect_clutter(scene, low, high, 0.1 * (high - low).prod());
}

TEST(RadarClutter, IsPoissonInTheRectangleAboutTheBoats) {
  MergingBoatsScene config;
  config.clutter = 3e-4;
  expect_clutter(make_scene(config), {-60, -60, 0}, {60, 80, 0}, 3e-4 * 120 * 140);
}

TEST(MergingBoats, AreOneEchoForAWhileAndThenPart) {
  const RadarScene scene = make_scene(exact_boats());
  ASSERT_EQ(scene.scans * scene.interval, 135);
  for (int scan = 0; scan < scene.scans; ++scan) {
    const double time = 2.5 * scan, second = time < 75 ? 20 : 20 + 0.3 * (time - 75);
    const std::vector<Eigen::Vector3d> points = points_at(scene, 1, scan);
    const bool one = time >= 30 && time < 75;
    ASSERT_EQ(points.size(), one ? 1u : 2u) << scan;
    EXPECT_LT((points.back() - Eigen::Vector3d(3 * time, second, 0)).norm(), 1e-9) << scan;
    EXPECT_LT((points.front() - Eigen::Vector3d(3 * time, one ? second : 0, 0)).norm(), 1e-9);
    const std::vector<TruthPoint> truth = truth_at(scene, scan);
    ASSERT_EQ(truth.size(), 2u);
    EXPECT_EQ(truth[0].y, 0);
    EXPECT_NEAR(truth[1].y, second, 1e-9);
    EXPECT_EQ(truth[1].vy, time > 75 ? 0.3 : 0);
  }
}

TEST(MergingBoats, AreMeasuredAsWellAsTheRadarIs) {
  MergingBoatsScene config = exact_boats();
  config.sd = 5;
  const RadarScene scene = make_scene(config);
  double squares = 0, product = 0;
  constexpr int kSeeds = 4000;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Eigen::Vector3d error = points_at(scene, seed, 20).front() - place_at(scene, 1, 20);
    squares += error.squaredNorm(), product += error.x() * error.y();
  }
  EXPECT_NEAR(squares / (2 * kSeeds), 25, 4 * 25 / std::sqrt(kSeeds));
  EXPECT_NEAR(product / kSeeds, 0, 4 * 25 / std::sqrt(kSeeds));
}

TEST(RadarScenes, AreFunctionsOfSettingsSeedAndScan) {
  for (const RadarSceneEntry& entry : all_radar_scenes()) {
    const ConfigSection config = entry.config();
    const RadarScene scene = entry.make(config);
    EXPECT_EQ(config.name(), "scenes." + std::string(entry.name));
    EXPECT_EQ(scene.name, entry.name);
    EXPECT_EQ(find_radar_scene(entry.name), &entry);
    EXPECT_EQ(points_at(scene, 3, 5), points_at(entry.make(config), 3, 5)) << entry.name;
    EXPECT_NE(points_at(scene, 3, 5), points_at(scene, 4, 5)) << entry.name;
    EXPECT_NE(points_at(scene, 3, 5), points_at(scene, 3, 6)) << entry.name;
    EXPECT_EQ(truth_of(scene).size(), scene.targets.size() * std::size_t(scene.scans));
  }
}

std::string refusal(std::string_view scene) {
  try {
    find_scene(scene);
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "";
}

TEST(RadarScenes, AreNoScenesOfFrames) {
  for (const RadarSceneEntry& entry : all_radar_scenes()) {
    const std::string name(entry.name);
    EXPECT_NE(refusal(name).find("glint simulate " + name), std::string::npos) << refusal(name);
    EXPECT_NE(refusal("nowhere").find(name), std::string::npos) << name;
  }
  EXPECT_EQ(find_radar_scene("crossing"), nullptr);
}

}  // namespace
}  // namespace glint

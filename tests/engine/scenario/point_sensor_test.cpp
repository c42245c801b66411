// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/scenario/point_sensor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "glint/engine/scenario/scenes.hpp"

namespace glint {
namespace {

Scene clip(const char* name, int variant = 0) {
  PmhtClipScene config;
  config.clip = name, config.variant = variant;
  return make_scene(config);
}

struct Place {
  const char* clip;
  std::int64_t target;
  int frame;
  double x, y;
};

// The truth that the bands of the experiments were found with.
const std::vector<Place> kPlaces{
    {"bs44", 0, 0, 60, 76.666666666666671},
    {"bs44", 0, 19, 375.71428571428572, 156.973092808552},
    {"bs44", 0, 38, 697.33053935860062, 81.394557823129261},
    {"bs44", 0, 56, 960, 160},
    {"bs44", 1, 0, 60, 135},
    {"bs44", 1, 19, 375.71428571428572, 91.532586248785222},
    {"bs44", 1, 38, 697.33053935860062, 175.22291059280852},
    {"bs44", 1, 56, 960, 91.666666666666671},
    {"bs49", 0, 0, 73.333333333333329, 68.333333333333329},
    {"bs49", 0, 16, 336.17283950617281, 208.14814814814815},
    {"bs49", 0, 32, 589.99999999999989, 86.543209876543244},
    {"bs49", 0, 48, 840, 143.33333333333334},
    {"bs49", 1, 0, 73.333333333333329, 190},
    {"bs49", 1, 16, 336.17283950617281, 48.148148148148152},
    {"bs49", 1, 32, 589.99999999999989, 173.39506172839504},
    {"bs49", 1, 48, 840, 110},
    {"bs50", 0, 0, 900, 65},
    {"bs50", 0, 14, 708.63219590727851, 188.011160442896},
    {"bs50", 0, 29, 507.16762884609744, 149.93839116891178},
    {"bs50", 0, 43, 290, 61.666666666666664},
    {"bs50", 1, 0, 891.66666666666663, 203.33333333333334},
    {"bs50", 1, 14, 690.27674712079852, 81.988839557103958},
    {"bs50", 1, 29, 475.67557992797282, 116.01393587985962},
    {"bs50", 1, 43, 268.33333333333331, 200},
    {"monte-carlo", 0, 0, 70, 70},
    {"monte-carlo", 0, 7, 222.25, 103.25},
    {"monte-carlo", 0, 14, 399, 161},
    {"monte-carlo", 0, 21, 600.25, 243.25},
    {"monte-carlo", 1, 0, 70, 200},
    {"monte-carlo", 1, 10, 270, 170},
    {"monte-carlo", 1, 20, 470, 140},
    {"monte-carlo", 1, 29, 650, 113},
    {"monte-carlo", 2, 0, 30, 30},
    {"monte-carlo", 2, 15, 180, 45},
    {"monte-carlo", 2, 21, 214.37746770784941, 87.016904976260363},
    {"monte-carlo", 2, 33, 112.36056273158903, 115.39437268410978},
    {"monte-carlo", 2, 41, 50.343657755328636, 147.77184039195922},
    {"monte-carlo", 2, 52, 134.72112546317814, 194.78874536821959},
    {"monte-carlo", 2, 62, 223.68346847343417, 227.79695354766736},
    {"monte-carlo", 2, 69, 204.80971469644007, 289.804434189267},
};

TEST(PmhtClips, PathsAreThoseThatTheBandsBelongTo) {
  for (const Place& place : kPlaces) {
    const auto truth = truth_at(clip(place.clip), place.frame);
    const auto at = std::ranges::find(truth, place.target, &TruthPoint::track_id);
    ASSERT_NE(at, truth.end());
    EXPECT_NEAR(at->x, place.x, 1e-9) << place.clip << " " << place.target << " " << place.frame;
    EXPECT_NEAR(at->y, place.y, 1e-9) << place.clip << " " << place.target << " " << place.frame;
  }
}

TEST(PmhtClips, LastAsLongAsThePapers) {
  EXPECT_EQ(clip("bs44").frames, 57);
  EXPECT_EQ(clip("bs49").frames, 49);
  EXPECT_EQ(clip("bs50").frames, 44);
  const Scene scene = clip("monte-carlo");
  EXPECT_EQ(truth_at(scene, 21).size(), 3u);
  EXPECT_EQ(truth_at(scene, 22).size(), 2u);
  EXPECT_EQ(truth_at(scene, 30).size(), 1u);
}

TEST(PmhtClips, TheCrowdStaysInThePictureAndVaries) {
  for (const TruthPoint& t : truth_of(clip("crowd", 3))) {
    EXPECT_TRUE(t.x > 10 && t.x < 1014 && t.y > 15 && t.y < 241) << t.x << " " << t.y;
    EXPECT_LE(std::hypot(t.vx, t.vy), 10);
  }
  EXPECT_EQ(truth_at(clip("crowd", 3), 0).size(), 40u);
  EXPECT_NE(truth_at(clip("crowd", 3), 5)[7].x, truth_at(clip("crowd", 4), 5)[7].x);
}

TEST(PointSensor, SeesEveryTargetAtItsNearestPixel) {
  const Scene scene = clip("bs44");
  const std::vector<PointMeasurement> points = points_at(scene, {}, 1, 20);
  ASSERT_EQ(points.size(), 2u);
  for (const TruthPoint& t : truth_at(scene, 20)) {
    EXPECT_TRUE(std::ranges::any_of(points, [&](const PointMeasurement& p) {
      return static_cast<double>(p.x) == std::round(t.x) &&
             static_cast<double>(p.y) == std::round(t.y);
    }));
  }
}

TEST(PointSensor, ErrorsHaveTheirVarianceAndThatOfRounding) {
  const Scene scene = clip("crowd");
  PointSensor sensor;
  sensor.variance = 2;
  double squares = 0, sum = 0;
  int count = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const auto truth = truth_at(scene, 30);
    for (const PointMeasurement& p : points_at(scene, sensor, seed, 30)) {
      double best = 1e9, error = 0;
      for (const TruthPoint& t : truth) {
        const double off =
            std::hypot(t.x - static_cast<double>(p.x), t.y - static_cast<double>(p.y));
        if (off < best) best = off, error = static_cast<double>(p.x) - t.x;
      }
      squares += error * error, sum += error, ++count;
    }
  }
  EXPECT_EQ(count, 1600);
  EXPECT_NEAR(sum / count, 0, 0.15);
  EXPECT_NEAR(squares / count, 2 + 1.0 / 12, 0.3);
}

TEST(PointSensor, ClutterIsAFixedNumberOverAllPixelsFromTheThirdFrameOn) {
  const Scene scene = clip("bs44");
  PointSensor sensor;
  sensor.clutter = PointSensor::clutter_of(scene, 0.03);
  EXPECT_EQ(sensor.clutter, 79);
  EXPECT_NEAR(sensor.clutter_density(scene), 3e-4, 2e-6);
  EXPECT_EQ(points_at(scene, sensor, 1, 1).size(), 2u);
  double left = 0, top = 0, all = 0;
  for (int frame = 2; frame < 42; ++frame) {
    const auto points = points_at(scene, sensor, 1, frame);
    EXPECT_EQ(points.size(), 81u);
    EXPECT_TRUE(std::ranges::is_sorted(points, {}, &PointMeasurement::y));
    for (const PointMeasurement& p : points) {
      EXPECT_TRUE(p.x >= 0 && p.x < 1024 && p.y >= 0 && p.y < 256);
      ++all, left += p.x < 512, top += p.y < 128;
    }
  }
  EXPECT_NEAR(left / all, 0.5, 0.05);
  EXPECT_NEAR(top / all, 0.5, 0.05);
}

TEST(PointSensor, IsAFunctionOfSceneSeedAndFrame) {
  const Scene scene = clip("bs50");
  PointSensor sensor;
  sensor.clutter = 20;
  EXPECT_EQ(points_at(scene, sensor, 3, 9), points_at(scene, sensor, 3, 9));
  EXPECT_NE(points_at(scene, sensor, 3, 9), points_at(scene, sensor, 4, 9));
  EXPECT_NE(points_at(scene, sensor, 3, 9), points_at(scene, sensor, 3, 10));
}

}  // namespace
}  // namespace glint

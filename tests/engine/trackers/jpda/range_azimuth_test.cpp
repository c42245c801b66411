// SPDX-License-Identifier: Apache-2.0
// imm-jpda on a sensor of range and azimuth.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "glint/engine/trackers/jpda/imm_jpda.hpp"

namespace glint {
namespace {

ImmJpdaConfig radar(Linearisation linearisation, double range_sd, double azimuth_sd) {
  ImmJpdaConfig config;
  config.measurement = MeasuredQuantity::range_azimuth, config.linearisation = linearisation;
  config.range_sd = range_sd, config.azimuth_sd = azimuth_sd;
  config.motion = "ncv", config.noise = 0.01;
  config.initiate = false, config.clutter_density = 1e-7, config.velocity_sd = 0.5;
  config.life.halt_misses = 0, config.life.halt_existence = 0;
  return config;
}

/// Mean squared error [px^2] over scans 5 to 29 of a target that passes along x = -`range` from a
/// sensor at (7, -3), upwards through azimuth pi.
double error_of(const ImmJpdaConfig& config, double range, unsigned seed) {
  constexpr int kScans = 30;
  ImmJpda tracker(config, Device::serial(), 1);
  TrackLog log;
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal;
  tracker.start(7 - range, -3 - 15, 0, 1);
  double sum = 0;
  for (int t = 0; t < kScans; ++t) {
    const double x = -range, y = t - 15;
    const double r = std::hypot(x, y) + config.range_sd * normal(engine);
    const double a = std::atan2(y, x) + config.azimuth_sd * normal(engine);
    const std::vector<PointMeasurement> points{{7 + r * std::cos(a), -3 + r * std::sin(a), 10}};
    Scan scan;
    scan.frame = t, scan.time = t, scan.sensor_x = 7, scan.sensor_y = -3, scan.points = points;
    tracker.step(scan, log);
    const auto now = log.at(t);
    if (now.size() != 1) return NAN;
    const double dx = now[0].x - 7 - x, dy = now[0].y + 3 - y;
    if (t >= 5) sum += (dx * dx + dy * dy) / (kScans - 5);
  }
  return sum;
}

double mean_error(Linearisation linearisation, double range, double azimuth_sd) {
  constexpr int kRuns = 40;
  double sum = 0;
  for (unsigned seed = 0; seed < kRuns; ++seed) {
    sum += error_of(radar(linearisation, 1, azimuth_sd), range, seed) / kRuns;
  }
  return sum;
}

// A point alone errs by 2 px^2.
TEST(RangeAzimuth, NearAndSharpBothFollowThroughAzimuthPi) {
  for (const Linearisation how : {Linearisation::extended, Linearisation::unscented}) {
    EXPECT_LT(mean_error(how, 100, 0.01), 0.7) << static_cast<int>(how);
  }
}

TEST(RangeAzimuth, ATrackStartsWithTheErrorsOfItsOwnSensor) {
  ImmJpda tracker(radar(Linearisation::extended, 2, 0.01), Device::serial(), 1);
  TrackLog log;
  tracker.start(500000 + 300, 5000000, 0, 1);
  Scan scan;  // the first: no track was followed from there before
  scan.sensor_x = 500000, scan.sensor_y = 5000000;
  tracker.step(scan, log);
  ASSERT_EQ(log.at(0).size(), 1u);
  EXPECT_NEAR(log.at(0)[0].var_x, 2 * 2, 1e-6);  // along the line of sight
  EXPECT_NEAR(log.at(0)[0].var_y, 3 * 3, 1e-6);  // 300 x 0.01 across it
}

// Where an arc of 3 sigma bends away from its tangent by many sigmas of range.
TEST(RangeAzimuth, WideAndFarTheUnscentedFilterBeatsTheExtended) {
  const double ekf = mean_error(Linearisation::extended, 400, 0.25),
               ukf = mean_error(Linearisation::unscented, 400, 0.25);
  RecordProperty("ekf", std::to_string(ekf));
  RecordProperty("ukf", std::to_string(ukf));
  EXPECT_LT(ukf, 0.8 * ekf) << ukf << " against " << ekf;
}

}  // namespace
}  // namespace glint

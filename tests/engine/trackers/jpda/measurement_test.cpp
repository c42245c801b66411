// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/jpda/measurement_prediction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "glint/engine/filters/motion.hpp"
#include "glint/engine/trackers/imm_pda_ai/pda.hpp"
#include "glint/experiments/radar.hpp"

namespace glint {
namespace {

constexpr double kPi = std::numbers::pi;

Gaussian<4> at(double x, double y, double variance) {
  Gaussian<4> state;
  state.mean << x, 1, y, -1;
  state.covariance *= variance;
  state.covariance(0, 1) = state.covariance(1, 0) = 0.3 * variance;
  return state;
}

RangeAzimuth radar() {
  RangeAzimuth sensor;
  sensor.noise.diagonal() << 4.5 * 4.5, 0.03 * 0.03;
  sensor.place << 10, -20;
  return sensor;
}

RangeAzimuthElevation papers_radar() {
  RangeAzimuthElevation sensor;
  sensor.noise.diagonal() << 400, 49e-6, 4e-6;  // P-JPDA section 5: mrad^2 is 1e-6 rad^2
  return sensor;
}

template <class Sensor>
void expect_slope(const Sensor& sensor, const Place<Sensor>& position) {
  for (int i = 0; i < Sensor::kAxes; ++i) {
    const Place<Sensor> step = 1e-4 * Place<Sensor>::Unit(i);
    const Measurement<Sensor> difference = (expected_measurement(sensor, position + step) -
                                            expected_measurement(sensor, position - step)) /
                                           2e-4;
    EXPECT_LT((jacobian(sensor, position).col(i) - difference).norm(), 1e-7);
  }
}

TEST(Measurement, WrapsAnglesToPlusPiIncluded) {
  EXPECT_EQ(wrapped(kPi), kPi);
  EXPECT_EQ(wrapped(-kPi), kPi);
  EXPECT_NEAR(wrapped(3 * kPi / 2), -kPi / 2, 1e-15);
  EXPECT_NEAR(wrapped(-kPi - 0.1), kPi - 0.1, 1e-15);
  EXPECT_EQ(wrapped(-0.25), -0.25);
  EXPECT_EQ(expected_measurement(RangeAzimuth{}, {-2, -0.0}).y(), kPi);
}

TEST(Measurement, SlopesAreDerivatives) {
  expect_slope(radar(), {50, 31});
  expect_slope(radar(), {-40, 7});
  expect_slope(papers_radar(), {105, -174, 40});
}

TEST(Measurement, LocatedUndoesMeasured) {
  const Eigen::Vector2d place(-55, 31);
  EXPECT_LT(
      (inverse_measurement(radar(), expected_measurement(radar(), place)).mean - place).norm(),
      1e-12);
  const Eigen::Vector3d high(1050, -174, 40);
  const Gaussian<3> found =
      inverse_measurement(papers_radar(), expected_measurement(papers_radar(), high));
  EXPECT_LT((found.mean - high).norm(), 1e-10);
  const Eigen::Matrix3d h = jacobian(papers_radar(), high);
  EXPECT_LT((h * found.covariance * h.transpose() - papers_radar().noise).norm(), 1e-9);
}

template <class Sensor>
void expect_continuous(const Sensor& sensor, Linearisation how) {
  // Just above and just below the half line at azimuth pi, what a measurement there tells is alike.
  const Gaussian<4> above = at(sensor.place.x() - 100, sensor.place.y() + 1e-6, 9);
  const Gaussian<4> below = at(sensor.place.x() - 100, sensor.place.y() - 1e-6, 9);
  const auto expect_above = predict_measurement(above, sensor, how);
  const auto expect_below = predict_measurement(below, sensor, how);
  EXPECT_GT(expect_above.mean(1), 3.14);
  EXPECT_LT(expect_below.mean(1), -3.14);
  for (const double azimuth : {kPi - 0.02, kPi, -kPi, -kPi + 0.02}) {
    const Eigen::Vector2d point(101, azimuth);
    EXPECT_NEAR(expect_above.distance(point), expect_below.distance(point), 1e-5);
    EXPECT_NEAR(expect_above.log_density(point), expect_below.log_density(point), 1e-5);
    EXPECT_LT((updated(above, expect_above, point).mean - updated(below, expect_below, point).mean)
                  .norm(),
              1e-5);
    EXPECT_LT(std::abs(expect_above.innovation(point)(1)), 0.021);
  }
}

TEST(Measurement, AzimuthGoesOnAcrossPi) {
  expect_continuous(radar(), Linearisation::extended);
  expect_continuous(radar(), Linearisation::unscented);
}

TEST(Measurement, AssociationWrapsToo) {
  const Gaussian<4> state = at(10 - 100, -20, 9);
  const auto expected = predict_measurement(state, radar());
  const std::array points{Eigen::Vector2d(100, kPi - 0.02), Eigen::Vector2d(100, -kPi + 0.02)};
  const Gaussian<4> both = pda_update(state, expected, points, std::array{0., .5, .5});
  EXPECT_LT((both.mean - state.mean).norm(), 1e-9);
  EXPECT_LT(both.covariance(0, 0), state.covariance(0, 0));
}

TEST(Measurement, UpdateIsTheLongFormOfKalmans) {
  const Gaussian<4> state = at(50, 31, 25);
  Eigen::Matrix<double, 2, 4> h = Eigen::Matrix<double, 2, 4>::Zero();
  const Eigen::Matrix2d j = jacobian(radar(), {50, 31});
  h.col(0) = j.col(0), h.col(2) = j.col(1);
  const Eigen::Vector2d point = expected_measurement(radar(), {53, 30});
  const auto expected = predict_measurement(state, radar());
  const Eigen::Matrix2d s = h * state.covariance * h.transpose() + radar().noise;
  const Eigen::Vector2d off = point - expected_measurement(radar(), {50, 31});
  EXPECT_LT((expected.covariance - s).norm(), 1e-12 * s.norm());
  EXPECT_NEAR(expected.distance(point), off.dot(s.inverse() * off), 1e-10);
  EXPECT_NEAR(expected.log_density(point),
              -off.dot(s.inverse() * off) / 2 - std::log(2 * kPi * std::sqrt(s.determinant())),
              1e-10);
  const Gaussian<4> after = updated(state, expected, point);
  // Information form.
  const Eigen::Matrix4d information =
      state.covariance.inverse() + h.transpose() * radar().noise.inverse() * h;
  EXPECT_LT((after.covariance - information.inverse()).norm(), 1e-10);
  const Eigen::Vector4d gained =
      information.inverse() * h.transpose() * radar().noise.inverse() * off;
  EXPECT_LT((after.mean - state.mean - gained).norm(), 1e-10);
}

TEST(Measurement, ChordsOfAShortSpreadAreTheTangent) {
  Gaussian<6> state;
  state.mean << 1000, 1, -700, 2, 300, 3;
  state.covariance *= 0.01;
  const auto ekf = predict_measurement(state, papers_radar(), Linearisation::extended);
  const auto ukf = predict_measurement(state, papers_radar(), Linearisation::unscented);
  EXPECT_LT((ekf.mean - ukf.mean).norm(), 1e-4);
  EXPECT_LT((ekf.gain - ukf.gain).norm(), 1e-6 * ekf.gain.norm());
}

TEST(Measurement, ChordsSeeHowRangeGrowsWithTheSpreadAcross) {
  Gaussian<4> state;
  state.mean << 100, 0, 0, 0;
  state.covariance.diagonal() << 1, 1, 400, 1;
  const auto ukf = predict_measurement(state, RangeAzimuth{}, Linearisation::unscented);
  // E range = 100 + 400 / (2 x 100) to second order; its variance 1 + 400^2 / (2 x 100^2).
  EXPECT_NEAR(ukf.mean(0), 102, 0.1);
  EXPECT_NEAR(ukf.covariance(0, 0) - 1, 1 + 8, 0.6);
  const auto ekf = predict_measurement(state, RangeAzimuth{}, Linearisation::extended);
  EXPECT_NEAR(ekf.mean(0), 100, 1e-12);
  EXPECT_NEAR(ekf.covariance(0, 0) - 1, 1, 1e-12);
}

TEST(Measurement, ASingularStateIsNoTrouble) {
  for (const Linearisation how : {Linearisation::extended, Linearisation::unscented}) {
    Gaussian<4> state = at(50, 31, 0);
    state.covariance.setZero();
    predict(NearlyConstantVelocity{25}, state, 1);
    const auto expected = predict_measurement(state, radar(), how);
    const Gaussian<4> after = updated(state, expected, expected.mean);
    EXPECT_TRUE(after.covariance.allFinite());
    EXPECT_LT(after.covariance(0, 0), state.covariance(0, 0));
    EXPECT_LT((after.mean - state.mean).norm(), 1e-9);
  }
}

TEST(Measurement, IsFiniteAtTheSensor) {
  for (const Linearisation how : {Linearisation::extended, Linearisation::unscented}) {
    const Gaussian<4> state = at(10, -20, 1);
    const auto expected = predict_measurement(state, radar(), how);
    EXPECT_TRUE(updated(state, expected, {1, 2}).mean.allFinite());
    Gaussian<6> still;
    const auto above = predict_measurement(still, papers_radar(), how);
    EXPECT_TRUE(updated(still, above, {1, 2, 1}).mean.allFinite());
  }
}

TEST(Measurement, ChordsOfAShortSpreadAreTheTangentFarFromTheOriginToo) {
  RangeAzimuth sensor = radar();
  sensor.place << 500000, 5000000;
  Gaussian<4> state = at(sensor.place.x() + 0.6, sensor.place.y() - 0.8, 1e-12);
  const auto ekf = predict_measurement(state, sensor, Linearisation::extended);
  const auto ukf = predict_measurement(state, sensor, Linearisation::unscented);
  EXPECT_LT((ekf.mean - ukf.mean).norm(), 1e-6);
  EXPECT_LT((ekf.gain - ukf.gain).norm(), 1e-3 * ekf.gain.norm());
}

TEST(Measurement, AUnitOfLengthIsFreeAtTheSensorToo) {
  for (const double length : {0.1, 1000.0}) {
    RangeAzimuth sensor, scaled;
    scaled.noise(0, 0) *= length * length;
    const Eigen::Vector2d to_measurement(1, length);
    const Eigen::Matrix2d expected = jacobian(sensor, {0, 0});
    EXPECT_LT((to_measurement.asDiagonal() * jacobian(scaled, {0, 0}) - expected).norm(),
              1e-9 * expected.norm());
    Gaussian<4> still;
    still.covariance.setZero();
    const auto chords = predict_measurement(still, sensor, Linearisation::unscented);
    const auto in_unit = predict_measurement(still, scaled, Linearisation::unscented);
    EXPECT_NEAR(in_unit.mean(0) / length, chords.mean(0), 1e-9 * chords.mean(0));
  }
}

TEST(Measurement, GateVolumeIsThatOfTheEllipsoid) {
  const auto flat = predict_position(at(0, 0, 3), 6 * Eigen::Matrix2d::Identity());
  EXPECT_NEAR(flat.gate_volume(16), kPi * 16 * 9, 1e-10);
  Gaussian<6> state;
  const PositionSensor<3> sensor{3 * Eigen::Matrix3d::Identity()};
  EXPECT_NEAR(predict_measurement(state, sensor).gate_volume(16), 4. / 3 * kPi * 64 * 8, 1e-9);
}

}  // namespace
}  // namespace glint

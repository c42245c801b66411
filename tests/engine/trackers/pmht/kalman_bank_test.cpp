// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/pmht/kalman_bank.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "glint/engine/trackers/pmht/pmht_em.hpp"

namespace glint {
namespace {

constexpr double kVariance = 4;

Mode<ConstantVelocity> at(double x, double y) {
  Mode<ConstantVelocity> mode{{0.1}, {}};
  mode.belief.mean << x, 1, y, 0;
  mode.belief.covariance = Eigen::Vector4d(3, 1, 3, 1).asDiagonal();
  return mode;
}

/// Two models that expect the target at (10, 20) and at (13, 20), as likely as 3 to 1.
KalmanBank bank_of_two() {
  return {{{at(10, 20), at(13, 20)}, staying(2, 1), {.75, .25}}, kVariance};
}

TEST(KalmanBank, ModesAreWhereTheModelsExpectTheTarget) {
  KalmanBank bank = bank_of_two();
  EXPECT_EQ(bank.mode(1).position, Eigen::Vector2d(13, 20));
  EXPECT_EQ(bank.mode(1).probability, .25);
  bank.predict(2);
  EXPECT_EQ(bank.mode(0).position, Eigen::Vector2d(12, 20));
  const PmhtCentroid half{0.5, {14, 20}};  // R / W = 8
  const double variance = 3 + 4 * 1 + 0.1 * 8 / 3;
  EXPECT_NEAR(bank.maximise(0, half).x(), 12 + 2 * variance / (variance + 8), 1e-12);
}

TEST(KalmanBank, StatesAreUpdatedByTheLastCentroidsAndProbabilitiesByTheFirst) {
  KalmanBank bank = bank_of_two();
  const std::array<PmhtCentroid, 2> first{{{1, {11, 20}}, {1, {11, 20}}}};
  const std::array<PmhtCentroid, 2> last{{{1, {17, 20}}, {1, {13, 20}}}};
  bank.update(first, last);
  const double ratio = std::exp((2.0 * 2 - 1.0 * 1) / (2 * 7));  // of N(11; 10, 7) and N(11; 13, 7)
  const double p = 3 * ratio / (3 * ratio + 1);
  EXPECT_NEAR(bank.probability()[0], p, 1e-12);
  EXPECT_NEAR(bank.mode(0).position.x(), 10 + 7 * 3.0 / 7, 1e-12);
  EXPECT_NEAR(bank.mode(1).position.x(), 13, 1e-12);
}

TEST(KalmanBank, WithoutPointsProbabilitiesStay) {
  KalmanBank bank = bank_of_two();
  const std::array<PmhtCentroid, 2> none{};
  bank.update(none, none);
  EXPECT_EQ(bank.probability()[0], .75);
  EXPECT_EQ(bank.mode(1).position.x(), 13);
}

}  // namespace
}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/filters/imm.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>

namespace glint {
namespace {

Mode<ConstantVelocity> cv(double x, double vx, double variance) {
  Mode<ConstantVelocity> mode{{0.5}, {}};
  mode.belief.mean << x, vx, -x, -vx;
  mode.belief.covariance = variance * Eigen::Matrix4d::Identity();
  return mode;
}

Mode<ConstantAcceleration> ca(double x, double vx, double ax, double variance) {
  Mode<ConstantAcceleration> mode{{0.1}, {}};
  mode.belief.mean << x, vx, ax, -x, -vx, -ax;
  mode.belief.covariance = variance * Eigen::Matrix<double, 6, 6>::Identity();
  return mode;
}

Imm::Switching switching(double a, double b, double c, double d) {
  Imm::Switching pi(2, 2);
  pi << a, b, c, d;
  return pi;
}

const Belief<ConstantVelocity>& cv_of(const Imm& imm, std::size_t i) {
  return std::get<Mode<ConstantVelocity>>(imm.modes()[i]).belief;
}

TEST(Imm, MixesByHand) {
  Imm imm({cv(0, 1, 1), cv(10, 3, 2)}, switching(.9, .1, .2, .8), {.6, .4});
  imm.mix();
  // c = (.6 x .9 + .4 x .2, .6 x .1 + .4 x .8) = (.62, .38)
  EXPECT_NEAR(imm.probability()[0], .62, 1e-15);
  EXPECT_NEAR(imm.probability()[1], .38, 1e-15);
  const double w = .08 / .62;  // of the second in the first
  EXPECT_NEAR(cv_of(imm, 0).mean(0), 10 * w, 1e-13);
  EXPECT_NEAR(cv_of(imm, 0).mean(1), 1 + 2 * w, 1e-13);
  EXPECT_NEAR(cv_of(imm, 0).covariance(0, 0), (1 - w) + 2 * w + 100 * w * (1 - w), 1e-12);
  EXPECT_NEAR(cv_of(imm, 0).covariance(0, 1), 20 * w * (1 - w), 1e-12);
  EXPECT_NEAR(cv_of(imm, 0).covariance(0, 2), -100 * w * (1 - w), 1e-12);
  const double u = .32 / .38;  // of the second in the second
  EXPECT_NEAR(cv_of(imm, 1).mean(0), 10 * u, 1e-13);
}

TEST(Imm, MixingKeepsTheMomentsOfTheWholeMixture) {
  Imm imm({cv(0, 1, 1), cv(10, 3, 2)}, switching(.7, .3, .2, .8), {.3, .7});
  const Gaussian<4> before = imm.combined();
  imm.mix();
  EXPECT_LT((imm.combined().mean - before.mean).norm(), 1e-12);
  EXPECT_LT((imm.combined().covariance - before.covariance).norm(), 1e-11);
}

TEST(Imm, AModelWithoutAccelerationDoesNotDragItToZero) {
  Imm imm({cv(0, 1, 1), ca(2, 5, 7, 3)}, switching(.5, .5, .5, .5), {.5, .5});
  imm.mix();
  const auto& mixed = std::get<Mode<ConstantAcceleration>>(imm.modes()[1]).belief;
  EXPECT_NEAR(mixed.mean(0), 1, 1e-14);
  EXPECT_NEAR(mixed.mean(1), 3, 1e-14);
  EXPECT_NEAR(mixed.mean(2), 7, 1e-14);
  EXPECT_NEAR(mixed.mean(5), -7, 1e-14);
  EXPECT_NEAR(mixed.covariance(2, 2), 3, 1e-14);
  EXPECT_NEAR(mixed.covariance(0, 0), (1 + 3) / 2.0 + 1, 1e-14);  // and the spread of the means
  EXPECT_NEAR(cv_of(imm, 0).mean(1), 3, 1e-14);
}

TEST(Imm, PredictsEachModelByItsOwnMotion) {
  Imm imm({cv(0, 1, 1), ca(0, 1, 2, 1)}, switching(1, 0, 0, 1), {.5, .5});
  imm.predict(2);
  EXPECT_NEAR(cv_of(imm, 0).mean(0), 2, 1e-14);
  EXPECT_NEAR(cv_of(imm, 0).covariance(0, 0), 1 + 4 + 0.5 * 8 / 3, 1e-13);  // P-HPMHT (22)
  EXPECT_NEAR(cv_of(imm, 0).covariance(0, 1), 2 + 0.5 * 2, 1e-13);
  EXPECT_NEAR(cv_of(imm, 0).covariance(1, 1), 1 + 0.5 * 2, 1e-13);
  const auto& other = std::get<Mode<ConstantAcceleration>>(imm.modes()[1]).belief;
  EXPECT_NEAR(other.mean(0), 0 + 2 + 4, 1e-14);
  EXPECT_NEAR(other.mean(1), 5, 1e-14);
  EXPECT_NEAR(other.covariance(2, 2), 1 + 0.1 * 2, 1e-13);
}

TEST(Imm, TwoHalfStepsAreOneWholeStep) {
  Imm whole({cv(3, 1, 1), ca(0, 1, 2, 1)}, switching(1, 0, 0, 1), {.5, .5}), halves = whole;
  whole.predict(2), halves.predict(0.7), halves.predict(1.3);
  EXPECT_LT((whole.combined().mean - halves.combined().mean).norm(), 1e-12);
  EXPECT_LT((whole.combined().covariance - halves.combined().covariance).norm(), 1e-11);
}

TEST(Imm, WeighsByBayesRule) {
  Imm imm({cv(0, 1, 1), cv(1, 1, 1)}, switching(.9, .1, .1, .9), {.6, .4});
  imm.weigh(std::array{std::log(.2) - 3000, std::log(.5) - 3000});
  EXPECT_NEAR(imm.probability()[0], .12 / .32, 1e-12);
  EXPECT_NEAR(imm.probability()[1], .20 / .32, 1e-12);
}

TEST(Imm, NormalisesRowsAndRefusesWhatIsNoMarkovChain) {
  Imm imm({cv(0, 1, 1), cv(1, 1, 1)}, switching(9, 1, 2, 8), {1, 0});
  imm.mix();
  EXPECT_NEAR(imm.probability()[1], 0.1, 1e-15);
  const auto make = [](const Imm::Switching& s) { return Imm({cv(0, 1, 1)}, s, {1}); };
  EXPECT_THROW(make(switching(1, 0, 0, 1)), std::invalid_argument);
  EXPECT_THROW(make(Imm::Switching::Constant(1, 1, -1)), std::invalid_argument);
  EXPECT_THROW(make(Imm::Switching::Zero(1, 1)), std::invalid_argument);
}

}  // namespace
}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/filters/imm.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "glint/experiments/radar.hpp"

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

Switching rows(double a, double b, double c, double d) {
  Switching pi(2, 2);
  pi << a, b, c, d;
  return pi;
}

const Belief<ConstantVelocity>& cv_of(const Imm& imm, std::size_t i) {
  return std::get<Mode<ConstantVelocity>>(imm.modes()[i]).belief;
}

TEST(Imm, MixesByHand) {
  Imm imm({cv(0, 1, 1), cv(10, 3, 2)}, rows(.9, .1, .2, .8), {.6, .4});
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

TEST(Imm, AModelThatNothingLeadsToGoesOnAsItWas) {
  Imm imm({cv(0, 1, 1), cv(10, 3, 2)}, staying(2, 1), {1, 0});
  imm.mix();
  EXPECT_EQ(imm.probability()[1], 0);
  EXPECT_EQ(cv_of(imm, 1).mean(0), 10);
  EXPECT_EQ(cv_of(imm, 1).covariance(0, 0), 2);
}

TEST(Imm, ModelsThatMayBeLeftShareWhatTheStayingLeaves) {
  const Switching three = staying(3, 0.9);
  EXPECT_EQ(three(0, 0), 0.9);
  EXPECT_NEAR(three(0, 1), 0.05, 1e-15);
  EXPECT_NEAR(three.row(2).sum(), 1, 1e-15);
  EXPECT_EQ(staying(1, 0.9)(0, 0), 1);
}

TEST(Imm, MixingKeepsTheMomentsOfTheWholeMixture) {
  Imm imm({cv(0, 1, 1), cv(10, 3, 2)}, rows(.7, .3, .2, .8), {.3, .7});
  const Gaussian<4> before = imm.combined();
  imm.mix();
  EXPECT_LT((imm.combined().mean - before.mean).norm(), 1e-12);
  EXPECT_LT((imm.combined().covariance - before.covariance).norm(), 1e-11);
}

TEST(Imm, AModelWithoutAccelerationDoesNotDragItToZero) {
  Imm imm({cv(0, 1, 1), ca(2, 5, 7, 3)}, rows(.5, .5, .5, .5), {.5, .5});
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
  Imm imm({cv(0, 1, 1), ca(0, 1, 2, 1)}, rows(1, 0, 0, 1), {.5, .5});
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
  Imm whole({cv(3, 1, 1), ca(0, 1, 2, 1)}, rows(1, 0, 0, 1), {.5, .5}), halves = whole;
  whole.predict(2), halves.predict(0.7), halves.predict(1.3);
  EXPECT_LT((whole.combined().mean - halves.combined().mean).norm(), 1e-12);
  EXPECT_LT((whole.combined().covariance - halves.combined().covariance).norm(), 1e-11);
}

TEST(Imm, WeighsByBayesRule) {
  Imm imm({cv(0, 1, 1), cv(1, 1, 1)}, rows(.9, .1, .1, .9), {.6, .4});
  imm.weigh(std::array{std::log(.2) - 3000, std::log(.5) - 3000});
  EXPECT_NEAR(imm.probability()[0], .12 / .32, 1e-12);
  EXPECT_NEAR(imm.probability()[1], .20 / .32, 1e-12);
}

using Vector9 = Eigen::Matrix<double, 9, 1>;
using Matrix9 = Eigen::Matrix<double, 9, 9>;

/// P-JPDA's bank: one model of 6 numbers, two of 9.
struct Bank {
  Mode<NearlyConstantVelocity, 3> slow{{25}, {}};
  Mode<WienerAcceleration, 3> fast{{56.25}, {}}, wild{{1600}, {}};
  Switching switching{3, 3};
  ModeProbability probability{.5, .3, .2};

  Bank() {
    slow.belief.mean.setLinSpaced(-1, 3), slow.belief.covariance *= 4;
    fast.belief.mean.setLinSpaced(2, 7), fast.belief.covariance *= 9;
    fast.belief.covariance(0, 4) = fast.belief.covariance(4, 0) = 2;
    wild.belief.mean.setLinSpaced(5, -2);
    switching << .8, .1, .1, .2, .7, .1, .3, .1, .6;
  }
  ImmOf<3> imm() const { return {{slow, fast, wild}, switching, probability}; }
  /// `slow` as the 9 numbers that a model with `own` acceleration sees.
  Gaussian<9> seen(const Gaussian<9>& own) const {
    Matrix9 rest = Matrix9::Zero();
    Eigen::Matrix<double, 9, 6> spread = Eigen::Matrix<double, 9, 6>::Zero();
    for (int axis = 0; axis < 3; ++axis) {
      rest(3 * axis + 2, 3 * axis + 2) = 1;
      spread(3 * axis, 2 * axis) = spread(3 * axis + 1, 2 * axis + 1) = 1;
    }
    return {spread * slow.belief.mean + rest * own.mean,
            spread * slow.belief.covariance * spread.transpose() +
                rest * own.covariance * rest.transpose()};
  }
};

TEST(Imm, MixesUnlikeModelsInThreeDimensionsLikeTheLongForm) {
  const Bank bank;
  ImmOf<3> imm = bank.imm();
  imm.mix();
  for (const int j : {1, 2}) {
    const Gaussian<9> own = j == 1 ? bank.fast.belief : bank.wild.belief;
    const std::array<Gaussian<9>, 3> from{bank.seen(own), bank.fast.belief, bank.wild.belief};
    Vector9 mean = Vector9::Zero();
    Matrix9 second = Matrix9::Zero();  // E x x'
    double sum = 0;
    for (int i = 0; i < 3; ++i) sum += bank.switching(i, j) * bank.probability[std::size_t(i)];
    for (int i = 0; i < 3; ++i) {
      const auto& part = from[std::size_t(i)];
      const double w = bank.switching(i, j) * bank.probability[std::size_t(i)] / sum;
      mean += w * part.mean;
      second += w * (part.covariance + part.mean * part.mean.transpose());
    }
    const auto& mixed = std::get<Mode<WienerAcceleration, 3>>(imm.modes()[std::size_t(j)]).belief;
    EXPECT_NEAR(imm.probability()[std::size_t(j)], sum, 1e-15);
    EXPECT_LT((mixed.mean - mean).norm(), 1e-13);
    EXPECT_LT((mixed.covariance - (second - mean * mean.transpose())).norm(), 1e-11);
  }
}

TEST(Imm, CombinesPositionAndVelocityOfUnlikeModels) {
  const Bank bank;
  const Gaussian<6> combined = bank.imm().combined();
  Eigen::Matrix<double, 6, 9> pick = Eigen::Matrix<double, 6, 9>::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    pick(2 * axis, 3 * axis) = pick(2 * axis + 1, 3 * axis + 1) = 1;
  }
  const Eigen::Matrix<double, 6, 1> a = bank.slow.belief.mean, b = pick * bank.fast.belief.mean,
                                    c = pick * bank.wild.belief.mean;
  const Eigen::Matrix<double, 6, 1> mean = .5 * a + .3 * b + .2 * c;
  Eigen::Matrix<double, 6, 6> second = .5 * bank.slow.belief.covariance;
  second += pick * (.3 * bank.fast.belief.covariance + .2 * bank.wild.belief.covariance) *
            pick.transpose();
  second += .5 * a * a.transpose() + .3 * b * b.transpose() + .2 * c * c.transpose();
  EXPECT_LT((combined.mean - mean).norm(), 1e-13);
  EXPECT_LT((combined.covariance - (second - mean * mean.transpose())).norm(), 1e-12);
}

TEST(Imm, TellsOfRowsThatDoNotSumToOne) {
  Switching papers(2, 2);
  papers << .7, .299, .25, .75;  // P-PMHT (33) has a row of 0.999
  const std::vector<std::string> notes = normalise_rows(papers);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0], "row 1 of the switching probabilities sums to 0.999 and was scaled to 1");
  EXPECT_NEAR(papers.row(0).sum(), 1, 1e-15);
  EXPECT_TRUE(normalise_rows(papers).empty());
}

TEST(Imm, NormalisesRowsAndRefusesWhatIsNoMarkovChain) {
  Imm imm({cv(0, 1, 1), cv(1, 1, 1)}, rows(9, 1, 2, 8), {1, 0});
  imm.mix();
  EXPECT_NEAR(imm.probability()[1], 0.1, 1e-15);
  const auto make = [](const Switching& s) { return Imm({cv(0, 1, 1)}, s, {1}); };
  EXPECT_THROW(make(rows(1, 0, 0, 1)), std::invalid_argument);
  EXPECT_THROW(make(Switching::Constant(1, 1, -1)), std::invalid_argument);
  EXPECT_THROW(make(Switching::Zero(1, 1)), std::invalid_argument);
}

}  // namespace
}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/imm_pda_ai/pda.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace glint {
namespace {

constexpr double kDetection = 0.9, kGate = 0.99, kClutter = 2e-3;

Gaussian<4> predicted() {
  Gaussian<4> state;
  state.mean << 10, 1, 20, -2;
  Eigen::Matrix4d root;
  root << 2, 0, 0, 0, .5, 1, 0, 0, .3, -.2, 1.5, 0, .1, .4, .6, .8;
  state.covariance = root * root.transpose();
  return state;
}

Eigen::Matrix2d noise() { return (Eigen::Matrix2d() << 2, .3, .3, 1).finished(); }

std::vector<Eigen::Vector2d> points() { return {{11, 21}, {8.5, 19}, {12, 18.5}}; }

std::vector<double> log_ratios(const PositionPrediction<4>& expected) {
  std::vector<double> ratios;
  for (const auto& z : points()) {
    ratios.push_back(std::log(kDetection / kClutter) + expected.log_density(z));
  }
  return ratios;
}

TEST(Pda, WeightsAreBayesRuleOverTheEventsWrittenOut) {
  const auto expected = predict_position(predicted(), noise());
  const Eigen::Matrix2d s = expected.covariance;
  std::array<double, 4> joint{(1 - kDetection * kGate) * std::pow(kClutter, 3), 0, 0, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector2d v = points()[i] - expected.mean;
    const double density = std::exp(-0.5 * v.dot(s.inverse() * v)) /
                           (2 * std::numbers::pi * std::sqrt(s.determinant()));
    joint[i + 1] = kDetection * density * std::pow(kClutter, 2);
  }
  const double all = joint[0] + joint[1] + joint[2] + joint[3];
  std::array<double, 4> beta{};
  const double log_likelihood = pda_weights(log_ratios(expected), 1 - kDetection * kGate, beta);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(beta[i], joint[i] / all, 1e-13);
  EXPECT_NEAR(log_likelihood, std::log(all / std::pow(kClutter, 3)), 1e-12);
}

TEST(Pda, UpdateHasTheMomentsOfTheMixtureOfKalmanUpdates) {
  const Gaussian<4> prior = predicted();
  const auto expected = predict_position(prior, noise());
  std::array<double, 4> beta{};
  pda_weights(log_ratios(expected), 1 - kDetection * kGate, beta);
  Eigen::Matrix<double, 2, 4> h = Eigen::Matrix<double, 2, 4>::Zero();
  h(0, 0) = h(1, 2) = 1;
  const Eigen::Matrix2d s = h * prior.covariance * h.transpose() + noise();
  const Eigen::Matrix<double, 4, 2> k = prior.covariance * h.transpose() * s.inverse();
  const Eigen::Matrix4d updated = (Eigen::Matrix4d::Identity() - k * h) * prior.covariance;
  std::vector<Eigen::Vector4d> means{prior.mean};
  for (const auto& z : points()) means.push_back(prior.mean + k * (z - h * prior.mean));
  Eigen::Vector4d mean = Eigen::Vector4d::Zero();
  Eigen::Matrix4d second = Eigen::Matrix4d::Zero();
  for (std::size_t i = 0; i < 4; ++i) {
    mean += beta[i] * means[i];
    second += beta[i] * ((i == 0 ? prior.covariance : updated) + means[i] * means[i].transpose());
  }
  const auto z = points();
  const Gaussian<4> result = pda_update<4>(prior, expected, z, beta);
  EXPECT_LT((result.mean - mean).norm(), 1e-12);
  EXPECT_LT((result.covariance - (second - mean * mean.transpose())).norm(), 1e-10);
}

TEST(Pda, NoPointsLeaveThePrediction) {
  const Gaussian<4> prior = predicted();
  std::array<double, 1> beta{};
  EXPECT_NEAR(pda_weights({}, 0.1, beta), std::log(0.1), 1e-15);
  EXPECT_EQ(beta[0], 1);
  const Gaussian<4> result = pda_update<4>(prior, predict_position(prior, noise()), {}, beta);
  EXPECT_EQ(result.mean, prior.mean);
  EXPECT_LT((result.covariance - prior.covariance).norm(), 1e-14);
}

TEST(Pda, EnormousRatiosDoNotOverflow) {
  const std::array<double, 2> ratios{4000, 4000 - std::log(3)};
  std::array<double, 3> beta{};
  EXPECT_NEAR(pda_weights(ratios, 0.1, beta), 4000 + std::log(4.0 / 3), 1e-9);
  EXPECT_NEAR(beta[1], 0.75, 1e-12);
  EXPECT_NEAR(beta[2], 0.25, 1e-12);
}

}  // namespace
}  // namespace glint

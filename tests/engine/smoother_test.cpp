// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/filters/smoother.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <stdexcept>
#include <vector>

#include <Eigen/Cholesky>

namespace glint {
namespace {

constexpr double kVariance = 0.7;

/// A time after the one before, and what was measured at it.
struct Look {
  double step;
  std::optional<Eigen::Vector2d> position;
};
const std::vector<Look> kLooks{{1, {{3, 1}}},     {0.5, {{4, 0}}},  {2, {}},
                               {1.5, {{9, -3}}},  {1, {{8, -2}}},   {0.1, {{8.5, -2.5}}},
                               {4, {{20, -9.5}}}, {1, {{22, -11}}}, {1, {}}};

template <class Model>
Gaussian<2 * Model::kParts> prior() {
  Gaussian<2 * Model::kParts> state;
  state.mean.setLinSpaced(2, -1);
  state.covariance *= 4;
  state.covariance(0, 1) = state.covariance(1, 0) = 1;
  return state;
}

/// The prior, then one step a look.
template <class Model>
std::vector<FilteredStep<2 * Model::kParts>> filtered(const Model& model) {
  std::vector<FilteredStep<2 * Model::kParts>> steps{{{}, prior<Model>()}};
  for (const Look& look : kLooks) {
    FilteredStep<2 * Model::kParts> next{linear_motion<2>(model, look.step), steps.back().belief};
    predict(next.motion, next.belief);
    if (look.position) {
      const auto expected = predict_position(next.belief, kVariance * Eigen::Matrix2d::Identity());
      next.belief = updated(next.belief, expected, *look.position);
    }
    steps.push_back(next);
  }
  return steps;
}

/// Mean and covariance of all states at once, given all positions: the joint Gaussian of the prior
/// and the motion, conditioned in one go. It takes singular noise, as least squares would not.
struct Joint {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

/// Motion from look to look, in matrices of any size: code for each model apart compiles for
/// minutes.
struct Motion {
  Eigen::MatrixXd transition, noise;
};

Joint joint(const Joint& prior, const std::vector<Motion>& motions) {
  const Eigen::Index size = prior.mean.size();
  const auto count = static_cast<Eigen::Index>(motions.size() + 1);
  Joint all{Eigen::VectorXd::Zero(size * count), Eigen::MatrixXd::Zero(size * count, size * count)};
  all.mean.head(size) = prior.mean;
  all.covariance.topLeftCorner(size, size) = prior.covariance;
  Eigen::MatrixXd h = Eigen::MatrixXd::Zero(2 * count, size * count);
  Eigen::VectorXd z = Eigen::VectorXd::Zero(2 * count);
  Eigen::Index rows = 0;
  for (Eigen::Index t = 1; t < count; ++t) {
    const Motion& motion = motions[static_cast<std::size_t>(t - 1)];
    const Look& look = kLooks[static_cast<std::size_t>(t - 1)];
    const Eigen::Index at = size * t, before = at - size;
    all.mean.segment(at, size) = motion.transition * all.mean.segment(before, size);
    all.covariance.block(at, 0, size, at) =
        motion.transition * all.covariance.block(before, 0, size, at);
    all.covariance.block(0, at, at, size) = all.covariance.block(at, 0, size, at).transpose();
    all.covariance.block(at, at, size, size) =
        motion.transition * all.covariance.block(before, at, size, size) + motion.noise;
    if (!look.position) continue;
    h(rows, at) = h(rows + 1, at + size / 2) = 1;
    z.segment(rows, 2) = *look.position;
    rows += 2;
  }
  h.conservativeResize(rows, Eigen::NoChange), z.conservativeResize(rows);
  const Eigen::MatrixXd s =
      h * all.covariance * h.transpose() + kVariance * Eigen::MatrixXd::Identity(rows, rows);
  const Eigen::MatrixXd gain = all.covariance * h.transpose() * s.inverse();
  return {all.mean + gain * (z - h * all.mean), all.covariance - gain * h * all.covariance};
}

template <class Model>
Joint joint(const Model& model) {
  std::vector<Motion> motions;
  for (const Look& look : kLooks) {
    const auto motion = linear_motion<2>(model, look.step);
    motions.push_back({motion.transition, motion.noise});
  }
  return joint({prior<Model>().mean, prior<Model>().covariance}, motions);
}

template <class Model>
void expect_exact(const Model& model) {
  constexpr Eigen::Index kSize = 2 * Model::kParts;
  const auto steps = filtered(model);
  std::vector<Gaussian<kSize>> smoothed(steps.size());
  smooth(std::span<const FilteredStep<kSize>>(steps), std::span(smoothed));
  const Joint all = joint(model);
  for (std::size_t t = 0; t < steps.size(); ++t) {
    const auto at = kSize * static_cast<Eigen::Index>(t);
    EXPECT_LT((smoothed[t].mean - all.mean.segment(at, kSize)).norm(), 1e-7) << t;
    EXPECT_LT((smoothed[t].covariance - all.covariance.block(at, at, kSize, kSize)).norm(), 1e-7)
        << t;
  }
}

TEST(Smoother, IsTheBatchSolutionForEveryModel) {
  expect_exact(ConstantVelocity{0.3});
  expect_exact(ConstantAcceleration{0.05});
  expect_exact(NearlyConstantVelocity{0.3});
  expect_exact(WienerAcceleration{0.02});
  expect_exact(Singer{0.2, 2});
  expect_exact(CoordinatedTurn{-0.4, 0.3});
}

TEST(Smoother, KeepsToThePastWithinItsLag) {
  // The batch solution of the first looks alone is what a lag of 3 can know of its begin.
  const auto steps = filtered(Singer{0.2, 2});
  const std::span all(steps);
  std::vector<Gaussian<6>> whole(7), lagged(4);
  smooth(all.first(7), std::span(whole));
  smooth(all.subspan(3, 4), std::span(lagged));
  for (std::size_t t = 0; t < 4; ++t) {
    EXPECT_LT((lagged[t].mean - whole[t + 3].mean).norm(), 1e-12);
    EXPECT_LT((lagged[t].covariance - whole[t + 3].covariance).norm(), 1e-12);
  }
}

TEST(Smoother, ExactStateWithoutNoiseStays) {
  FilteredStep<4> first, second;
  first.belief.covariance.setZero();
  second.motion = linear_motion<2>(ConstantVelocity{0}, 1);
  second.belief = first.belief;
  const std::vector steps{first, second};
  std::vector<Gaussian<4>> smoothed(2);
  smooth(std::span<const FilteredStep<4>>(steps), std::span(smoothed));
  EXPECT_EQ(smoothed[0].mean, first.belief.mean);
  EXPECT_EQ(smoothed[0].covariance, first.belief.covariance);
}

TEST(Smoother, RefusesTooLittleRoom) {
  const std::vector<FilteredStep<4>> steps(2);
  std::vector<Gaussian<4>> room(1);
  EXPECT_THROW(smooth(std::span<const FilteredStep<4>>(steps), std::span(room)),
               std::invalid_argument);
}

}  // namespace
}  // namespace glint

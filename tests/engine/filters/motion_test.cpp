// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/filters/motion.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace glint {
namespace {

/// Of one axis over one step, with unit variance; made by the closed forms in 60 digits, which
/// numerical integration of the impulse responses confirms.
struct SingerCase {
  double fading, step;
  std::array<double, 3> transition;  ///< last column
  std::array<double, 6> noise;       ///< rows of the upper triangle
};
constexpr SingerCase kSinger[] = {
    {1e-9,
     1,
     {0.49999999983333333, 0.9999999995, 0.999999999},
     {9.9999999944444432e-11, 2.4999999983333333e-10, 3.33333333e-10, 6.6666666616666667e-10,
      9.99999999e-10, 1.999999998e-9}},
    {1e-5,
     2,
     {1.9999866667333331, 1.9999800001333327, 0.99998000019999867},
     {3.1999644446984113e-5, 3.9999466671111083e-5, 2.6666133339199954e-5, 5.3332533340799947e-5,
      3.9999200009333253e-5, 3.999920001066656e-5}},
    {1e-3,
     1,
     {0.49983337499166806, 0.99950016662500833, 0.99900049983337499},
     {9.9944464280160042e-5, 0.00024983340275556146, 0.00033300018326113372, 0.00066616689991669126,
      0.00099900058308341942, 0.0019980013326669332}},
    {0.049,
     1,
     {0.49193240254262947, 0.97589531227541116, 0.95218112969850485},
     {0.0047689137568057614, 0.011857876944896819, 0.015554158944441112, 0.031493144564136688,
      0.046666211365534991, 0.093351096246079079}},
    {0.05,
     1,
     {0.49176980028560364, 0.97541150998571982, 0.95122942450071401},
     {0.0048635569533361279, 0.012091876823647124, 0.015855805587610371, 0.032111986758585281,
      0.0475713806906311, 0.095162581964040427}},
    {0.2,
     1,
     {0.46826882694954647, 0.90634623461009071, 0.81873075307798186},
     {0.017928022067841033, 0.043855138858540859, 0.054691318329198895, 0.11507415690720335,
      0.16429269939837792, 0.3296799539643607}},
    {0.25,
     1.99,
     {1.6887821336115395, 1.5678044665971151, 0.60804888335072122},
     {0.59810572919614824, 0.71299627370138594, 0.40428666435157444, 0.91955342174121443,
      0.61450271137046616, 0.63027655545594102}},
    {0.25,
     2.01,
     {1.7202596302902914, 1.5799350924274271, 0.60501622689314321},
     {0.62715978003629809, 0.73982329890162254, 0.41462491469401151, 0.9443243642969201,
      0.62404872407091569, 0.63395536519598465}},
    {3,
     1.5,
     {0.39012322183758248, 0.32963033448725256, 0.011108996538242306},
     {0.37098660064824138, 0.45658838465080677, 0.099988402372414729, 0.67159028626098695,
      0.32596847224253402, 0.99987659019591332}},
    {20,
     2,
     {0.0975, 0.05, 4.248354255291589e-18},
     {0.24717291666666667, 0.190125, 0.0024999999999999992, 0.1925, 0.05, 1.0}},
};

TEST(Singer, MatricesHaveTwelveDigitsForEveryStep) {
  for (const SingerCase& c : kSinger) {
    const Singer model{c.fading, 1};
    const Eigen::Matrix3d f = transition(model, c.step), q = process_noise(model, c.step);
    for (int i = 0; i < 3; ++i) {
      const double expected = c.transition[static_cast<std::size_t>(i)];
      EXPECT_NEAR(f(i, 2), expected, 1e-12 * expected) << c.fading << " row " << i;
    }
    std::size_t at = 0;
    for (int i = 0; i < 3; ++i) {
      for (int j = i; j < 3; ++j, ++at) {
        EXPECT_NEAR(q(i, j), c.noise[at], 1e-12 * c.noise[at]) << c.fading << " at " << i << j;
        EXPECT_EQ(q(i, j), q(j, i));
      }
    }
    EXPECT_EQ(f(0, 1), c.step);
    EXPECT_EQ(f(1, 0), 0);
  }
}

TEST(Singer, WithoutFadingIsConstantAccelerationWithoutNoise) {
  EXPECT_EQ(transition(Singer{0, 2}, 3), transition(ConstantAcceleration{}, 3));
  EXPECT_EQ(process_noise(Singer{0, 2}, 3), Eigen::Matrix3d::Zero());
}

TEST(Motion, PapersConstantAccelerationIsAWienerProcess) {
  // P-PMHT: Q = q G G' with G = [.5 1 1] for steps of one frame
  const Eigen::Matrix3d q = process_noise(WienerAcceleration{0.01}, 1);
  const Eigen::Vector3d g(.5, 1, 1);
  EXPECT_LT((q - 0.01 * g * g.transpose()).norm(), 1e-17);
  const Eigen::Matrix3d longer = process_noise(WienerAcceleration{0.01}, 2);
  EXPECT_DOUBLE_EQ(longer(0, 0), 0.01 * 4);
  EXPECT_DOUBLE_EQ(longer(0, 1), 0.01 * 4);
  EXPECT_DOUBLE_EQ(longer(1, 2), 0.01 * 2);
}

TEST(Motion, NearlyConstantVelocityHasNoiseOfRankOne) {
  const Eigen::Matrix2d q = process_noise(NearlyConstantVelocity{25}, 2);
  EXPECT_DOUBLE_EQ(q(0, 0), 25 * 4);
  EXPECT_DOUBLE_EQ(q(0, 1), 25 * 4);
  EXPECT_DOUBLE_EQ(q(1, 1), 25 * 4);
  EXPECT_NEAR(q.determinant(), 0, 1e-9);
}

TEST(Motion, TurnsFromXTowardsYOnACircle) {
  const CoordinatedTurn turn{std::numbers::pi / 4, 0};
  Gaussian<4> belief;
  belief.mean << 0, 3, 0, 0;
  predict(turn, belief, 1.5), predict(turn, belief, 0.5);
  const double radius = 3 / turn.rate;
  EXPECT_NEAR(belief.mean(0), radius, 1e-12);
  EXPECT_NEAR(belief.mean(1), 0, 1e-12);
  EXPECT_NEAR(belief.mean(2), radius, 1e-12);
  EXPECT_NEAR(belief.mean(3), 3, 1e-12);
}

TEST(Motion, OppositeTurnsMirrorEachOther) {
  Gaussian<4> left, right;
  left.mean << 1, 2, 0, 0, right.mean << 1, 2, 0, 0;
  predict(CoordinatedTurn{0.3, 1}, left, 2), predict(CoordinatedTurn{-0.3, 1}, right, 2);
  EXPECT_DOUBLE_EQ(left.mean(0), right.mean(0));
  EXPECT_DOUBLE_EQ(left.mean(2), -right.mean(2));
  EXPECT_DOUBLE_EQ(left.covariance(0, 2), -right.covariance(0, 2));
}

TEST(Motion, ASlowTurnIsAStraightLine) {
  const Eigen::Matrix4d straight = linear_motion<2>(ConstantVelocity{}, 2).transition;
  EXPECT_LT((transition(CoordinatedTurn{1e-13, 1}, 2) - straight).norm(), 1e-12);
  EXPECT_EQ(transition(CoordinatedTurn{0, 1}, 2), straight);
}

TEST(Motion, AxesAreAlikeAndIndependent) {
  const LinearMotion<9> motion = linear_motion<3>(WienerAcceleration{56.25}, 0.5);
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Matrix3d f = motion.transition.block<3, 3>(3 * axis, 3 * axis);
    EXPECT_EQ(f, transition(WienerAcceleration{}, 0.5));
  }
  EXPECT_EQ((motion.transition.block<3, 3>(0, 3)).norm(), 0);
  EXPECT_EQ((motion.noise.block<3, 6>(0, 3)).norm(), 0);
  const LinearMotion<6> turn = linear_motion<3>(CoordinatedTurn{0.1, 2}, 0.5);
  const Eigen::Matrix2d height = turn.transition.bottomRightCorner<2, 2>();
  EXPECT_EQ(height, transition(ConstantVelocity{}, 0.5));
}

template <class Model>
void expect_steps_add(const Model& model) {
  Gaussian<3 * Model::kParts> whole;
  whole.mean.setLinSpaced(1, 2);
  whole.covariance *= 3;
  auto parts = whole;
  predict(model, whole, 1.7), predict(model, parts, 0.4), predict(model, parts, 1.3);
  EXPECT_LT((whole.mean - parts.mean).norm(), 1e-12);
  EXPECT_LT((whole.covariance - parts.covariance).norm(), 1e-11);
}

TEST(Motion, UnevenStepsAddUpForModelsOfContinuousTime) {
  expect_steps_add(ConstantVelocity{0.7});
  expect_steps_add(ConstantAcceleration{0.7});
  expect_steps_add(Singer{0.2, 2});
  expect_steps_add(Singer{1e-4, 2});
  expect_steps_add(CoordinatedTurn{0.9, 0});
}

TEST(Motion, PartsThatTheSourceLacksStayAsTheyWere) {
  Gaussian<6> from;
  from.mean << 1, 2, 3, 4, 5, 6;
  from.covariance.diagonal() << 1, 2, 3, 4, 5, 6;
  from.covariance(0, 5) = from.covariance(5, 0) = 0.5;
  Gaussian<9> own;
  own.mean.setConstant(7);
  own.covariance.setConstant(0.1), own.covariance.diagonal().setConstant(8);
  const Gaussian<9> seen = embed<3>(from, own);
  Eigen::Matrix<double, 9, 1> mean, variance;
  mean << 1, 2, 7, 3, 4, 7, 5, 6, 7;
  variance << 1, 2, 8, 3, 4, 8, 5, 6, 8;
  EXPECT_EQ(seen.mean, mean);
  EXPECT_EQ(seen.covariance.diagonal(), variance);
  EXPECT_EQ(seen.covariance(0, 7), 0.5);
  EXPECT_EQ(seen.covariance(2, 0), 0);
  EXPECT_EQ(seen.covariance(2, 5), 0.1);
  EXPECT_EQ((embed<3>(seen, from).mean), from.mean);
  EXPECT_EQ((embed<3>(seen, from).covariance), from.covariance);
}

}  // namespace
}  // namespace glint

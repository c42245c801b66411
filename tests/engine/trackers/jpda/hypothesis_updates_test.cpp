// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/jpda/hypothesis_updates.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "still_targets.hpp"

namespace glint::test {
namespace {

using Sensor = PositionSensor<2>;  // variance 1
using Numbers = std::vector<std::uint32_t>;
constexpr double kDetection = 0.8;

/// Two targets of one hypothesis each, at 0 and at 10, with a model of variance 3 and one of 15:
/// innovations have the variances 4 and 16, gains are 3/4 and 15/16.
class HypothesisUpdatesOfTwo : public testing::Test {
 protected:
  void SetUp() override {
    for (const double x : {0.0, 10.0}) {
      const Imm bank = still_bank(x, {3, 15});
      const auto expected = predict_measurements(bank, Sensor{}, Linearisation::extended);
      updates_.add(bank, expected, points_, x == 0 ? near_ : far_, log_weight_);
    }
  }
  const std::vector<Eigen::Vector2d> points_{{2, 0}, {8, 0}, {0, 4}};
  const Numbers near_{0, 2}, far_{1};
  HypothesisUpdates<Sensor> updates_{kDetection};
  std::vector<double> log_weight_;
};

TEST_F(HypothesisUpdatesOfTwo, AreMovedByTheirGainsTowardsEachPoint) {
  const auto first = updates_.belief<4>(0, 0, 0);
  EXPECT_NEAR(first.mean(0), 0.75 * 2, 1e-12);
  EXPECT_NEAR(first.mean(2), 0, 1e-12);
  EXPECT_NEAR(updates_.belief<4>(0, 1, 1).mean(2), 15.0 / 16 * 4, 1e-12);
  EXPECT_NEAR(updates_.belief<4>(1, 0, 0).mean(0), 10 - 0.75 * 2, 1e-12);
  EXPECT_NEAR(updates_.belief<4>(1, 0, 1).mean(0), 10 - 15.0 / 16 * 2, 1e-12);
}

TEST_F(HypothesisUpdatesOfTwo, GainTheSameCovarianceFromEveryPoint) {
  for (const std::size_t point : {0u, 1u}) {
    EXPECT_NEAR((*updates_.belief<4>(0, point, 0).covariance)(0, 0), 0.75, 1e-12);
    EXPECT_NEAR((*updates_.belief<4>(0, point, 1).covariance)(2, 2), 15.0 / 16, 1e-12);
    EXPECT_NEAR((*updates_.belief<4>(0, point, 1).covariance)(0, 2), 0, 1e-12);
  }
}

TEST_F(HypothesisUpdatesOfTwo, HaveTheirPointsWithTheDensityOfAllModels) {
  const auto weight = [](double off) {
    return std::log(kDetection * (density(off, 4) + density(off, 16)) / 2);
  };
  const std::vector expected{std::log(0.2), weight(2), weight(4), std::log(0.2), weight(-2)};
  ASSERT_EQ(log_weight_.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(log_weight_[i], expected[i], 1e-12) << i;
  }
}

TEST_F(HypothesisUpdatesOfTwo, BelieveTheModelThatExpectedThePoint) {
  const auto second = [](double off) {
    return density(off, 16) / (density(off, 4) + density(off, 16));
  };
  EXPECT_NEAR(updates_.probability(0, 0)[1], second(2), 1e-12);
  EXPECT_NEAR(updates_.probability(0, 1)[1], second(4), 1e-12);
  EXPECT_NEAR(updates_.probability(0, 1)[0], 1 - second(4), 1e-12);
  EXPECT_NEAR(updates_.probability(1, 0)[1], second(2), 1e-12);
}

TEST_F(HypothesisUpdatesOfTwo, AreForgottenWithTheScan) {
  updates_.clear();
  const Imm bank = still_bank(0, {3});
  const auto expected = predict_measurements(bank, Sensor{}, Linearisation::extended);
  updates_.add(bank, expected, points_, far_, log_weight_);
  EXPECT_NEAR(updates_.belief<4>(0, 0, 0).mean(0), 0.75 * 8, 1e-12);
  EXPECT_NEAR(updates_.probability(0, 0)[0], 1, 1e-12);
}

// Models of unlike dimension: a point moves the velocity and the acceleration that go with it.
TEST(HypothesisUpdates, MovesWhatTheModelHas) {
  Gaussian<6> state;
  state.covariance.diagonal() << 3, 1, 1, 3, 1, 1;
  state.covariance(0, 1) = state.covariance(1, 0) = 0.8;
  state.covariance(0, 2) = state.covariance(2, 0) = 0.4;
  const Imm bank(
      {Mode<NearlyConstantVelocity>{{0}, still(0, 3)}, Mode<WienerAcceleration>{{0}, state}},
      staying(2, 1), {0.5, 0.5});
  HypothesisUpdates<Sensor> updates(kDetection);
  std::vector<double> log_weight;
  updates.add(bank, predict_measurements(bank, Sensor{}, Linearisation::extended),
              std::vector<Eigen::Vector2d>{{2, 0}}, Numbers{0}, log_weight);
  const auto belief = updates.belief<6>(0, 0, 1);
  EXPECT_NEAR(belief.mean(1), 0.8 / 4 * 2, 1e-12);
  EXPECT_NEAR(belief.mean(2), 0.4 / 4 * 2, 1e-12);
  EXPECT_NEAR((*belief.covariance)(1, 1), 1 - 0.8 * 0.8 / 4, 1e-12);
  EXPECT_NEAR((*belief.covariance)(1, 2), -0.8 * 0.4 / 4, 1e-12);
  EXPECT_NEAR(updates.belief<4>(0, 0, 0).mean(0), 1.5, 1e-12);
}

}  // namespace
}  // namespace glint::test

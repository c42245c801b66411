// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/jpda/hypothesis_mixture.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "still_targets.hpp"

namespace glint::test {
namespace {

using Sensor = PositionSensor<2>;  // variance 1

/// A hypothesis at 0 with two models, variances 3 and 15, and one at 8; a point at 4, which is in
/// the gate of both.
class HypothesisMixtureOfTwo : public testing::Test {
 protected:
  void SetUp() override {
    for (const double x : {0.0, 8.0}) {
      const Imm bank = still_bank(x, {3, 15});
      hypotheses_.push_back({{}, bank});
      updates_.add(bank, predict_measurements(bank, Sensor{}, Linearisation::extended),
                   std::vector<Eigen::Vector2d>{{4, 0}}, std::vector<std::uint32_t>{0},
                   log_weight_);
    }
  }
  HypothesisMixture<Sensor> mixture(std::span<const Branch> branches) const {
    return {branches, hypotheses_, updates_};
  }
  std::vector<Hypothesis<2>> hypotheses_;
  HypothesisUpdates<Sensor> updates_{0.9};
  std::vector<double> log_weight_;
};

TEST_F(HypothesisMixtureOfTwo, KeepTheirPredictionWithoutAPoint) {
  const std::array branches{Branch{1, 0}, Branch{0, 0}};
  const auto parts = mixture(branches);
  EXPECT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts.probability(0, 1), 0.5);
  EXPECT_EQ(parts.belief<4>(0, 0).mean(0), 8);
  EXPECT_EQ((*parts.belief<4>(0, 1).covariance)(0, 0), 15);
  EXPECT_EQ(parts.belief<4>(1, 0).mean(0), 0);
}

TEST_F(HypothesisMixtureOfTwo, AreUpdatedByTheirPoint) {
  const std::array branches{Branch{1, 1}, Branch{0, 1}};
  const auto parts = mixture(branches);
  EXPECT_NEAR(parts.belief<4>(0, 0).mean(0), 8 - 0.75 * 4, 1e-12);
  EXPECT_NEAR((*parts.belief<4>(0, 0).covariance)(0, 0), 0.75, 1e-12);
  EXPECT_NEAR(parts.belief<4>(1, 0).mean(0), 0.75 * 4, 1e-12);
  EXPECT_NEAR(parts.probability(0, 1), density(4, 16) / (density(4, 4) + density(4, 16)), 1e-12);
}

TEST_F(HypothesisMixtureOfTwo, GiveTheirFirstBeliefs) {
  const std::array branches{Branch{1, 1}, Branch{0, 0}};
  Imm bank = still_bank(-5, {1, 1});
  mixture(branches).take_first(bank);
  EXPECT_NEAR(belief_of<4>(bank.modes()[0]).mean(0), 5, 1e-12);
  EXPECT_NEAR(belief_of<4>(bank.modes()[1]).mean(0), 8 - 15.0 / 16 * 4, 1e-12);
  EXPECT_NEAR(belief_of<4>(bank.modes()[1]).covariance(0, 0), 15.0 / 16, 1e-12);
}

// By moments: of two at 0 and 8 the mean is at the weighted place between, and the spread between
// them, w (1 - w) 8^2, adds to the variance.
TEST_F(HypothesisMixtureOfTwo, AreMixedByMoments) {
  const std::array branches{Branch{0, 0}, Branch{1, 0}};
  Imm bank = still_bank(-5, {1, 1});
  mix_banks(mixture(branches), std::array{0.25, 0.75}, bank);
  EXPECT_NEAR(belief_of<4>(bank.modes()[0]).mean(0), 6, 1e-12);
  EXPECT_NEAR(belief_of<4>(bank.modes()[0]).covariance(0, 0), 3 + 0.25 * 0.75 * 64, 1e-12);
  EXPECT_NEAR(belief_of<4>(bank.modes()[0]).covariance(2, 2), 3, 1e-12);
  EXPECT_NEAR(belief_of<4>(bank.modes()[1]).covariance(0, 0), 15 + 0.25 * 0.75 * 64, 1e-12);
  EXPECT_NEAR(bank.probability()[0], 0.5, 1e-12);
}

// A model counts in a component by its probability there: .9 of .5 against .3 of .5 for the first.
TEST_F(HypothesisMixtureOfTwo, AreMixedByHowLikelyTheModelIsInEach) {
  hypotheses_[0].bank.set_probability({0.9, 0.1});
  hypotheses_[1].bank.set_probability({0.3, 0.7});
  const std::array branches{Branch{0, 0}, Branch{1, 0}};
  Imm bank = still_bank(-5, {1, 1});
  mix_banks(mixture(branches), std::array{0.5, 0.5}, bank);
  EXPECT_NEAR(bank.probability()[0], 0.6, 1e-12);
  EXPECT_NEAR(belief_of<4>(bank.modes()[0]).mean(0), 8 * 0.25, 1e-12);
  EXPECT_NEAR(belief_of<4>(bank.modes()[1]).mean(0), 8 * 0.875, 1e-12);
}

TEST_F(HypothesisMixtureOfTwo, LeaveAModelAloneThatIsNowhereLikely) {
  for (auto& hypothesis : hypotheses_) hypothesis.bank.set_probability({1, 0});
  const std::array branches{Branch{0, 0}, Branch{1, 0}};
  Imm bank = still_bank(-5, {1, 2});
  mix_banks(mixture(branches), std::array{0.5, 0.5}, bank);
  EXPECT_EQ(bank.probability()[1], 0);
  EXPECT_EQ(belief_of<4>(bank.modes()[1]).mean(0), -5);
  EXPECT_EQ(belief_of<4>(bank.modes()[1]).covariance(0, 0), 2);
}

}  // namespace
}  // namespace glint::test

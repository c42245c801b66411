// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/motion_bank.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

#include "glint/engine/config.hpp"

namespace glint {
namespace {

TEST(MotionBank, OfTurnsHasThePapersChainAndShares) {
  const MotionBank bank = motion_bank("cv+ct", 1e-3, 0.2);
  EXPECT_EQ(bank.names, (std::vector<std::string>{"cv", "ct-", "ct+"}));
  ASSERT_EQ(bank.modes.size(), 3U);
  EXPECT_EQ(bank.modes[0].motion, Motion::constant_velocity);
  EXPECT_EQ(bank.modes[1].turn_rate, -0.2F);
  EXPECT_EQ(bank.modes[2].turn_rate, 0.2F);
  for (const MotionMode& mode : bank.modes) EXPECT_EQ(mode.noise, 1e-3F);
  EXPECT_EQ(bank.switching,
            (std::vector<float>{.8F, .1F, .1F, .3F, .6F, .1F, .3F, .1F, .6F}));  // P-PHD (39)
  EXPECT_EQ(bank.birth, (std::vector<float>{.8F, .1F, .1F}));                    // section 5.2
  EXPECT_FALSE(bank.has_acceleration());
}

TEST(MotionBank, OfOneModelDoesNotSwitch) {
  const MotionBank cv = motion_bank("cv", 0.5, 0.2), ca = motion_bank("ca", 0.5, 0.2);
  for (const MotionBank& bank : {cv, ca}) {
    ASSERT_EQ(bank.modes.size(), 1U);
    EXPECT_EQ(bank.modes[0].noise, 0.5F);
    EXPECT_EQ(bank.modes[0].turn_rate, 0);
    EXPECT_TRUE(bank.switching.empty());
    EXPECT_EQ(bank.birth, std::vector<float>{1});
  }
  EXPECT_EQ(cv.modes[0].motion, Motion::constant_velocity);
  EXPECT_EQ(ca.modes[0].motion, Motion::constant_acceleration);
  EXPECT_TRUE(ca.has_acceleration());
  EXPECT_FALSE(cv.has_acceleration());
}

TEST(MotionBank, OfAnotherNameIsRefused) {
  EXPECT_THROW(motion_bank("ct", 1e-3, 0.2), ConfigError);
}

TEST(MotionBank, TakesTheTurnRateOfTheSettingsInDegrees) {
  MotionConfig config;
  config.motion = "cv+ct", config.turn_rate = 15, config.process_noise = 0.3;
  const MotionBank bank = config.bank();
  EXPECT_NEAR(bank.modes[2].turn_rate, std::numbers::pi / 12, 1e-6);
  EXPECT_EQ(bank.modes[2].noise, 0.3F);
}

// Stationary shares of P-PHD (39): (.6, .2, .2). Bayes: P(i before | j now) = p_i Pi_ij / p_j.
TEST(MotionBank, ReversedTurnsTheOtherWayAndSwitchesByBayes) {
  const MotionBank bank = motion_bank("cv+ct", 1e-3, 0.2);
  const MotionBank back = reversed(bank);
  const double share[3] = {0.6, 0.2, 0.2};
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(back.switching[j * 3 + i], share[i] * bank.switching[i * 3 + j] / share[j], 1e-6)
          << i << ' ' << j;
    }
  }
  EXPECT_EQ(back.modes[1].turn_rate, 0.2F);
  EXPECT_EQ(back.modes[2].turn_rate, -0.2F);
  EXPECT_EQ(back.names, bank.names);
  EXPECT_TRUE(reversed(motion_bank("cv", 1e-3, 0)).switching.empty());
}

// A chain that is not its own reverse: 0 -> 1 -> 2 -> 0, stationary shares 1/3 each.
TEST(MotionBank, ReversedRunsACycleBackwards) {
  MotionBank bank = motion_bank("cv+ct", 1e-3, 0.2);
  bank.switching = {.1F, .9F, 0, 0, .1F, .9F, .9F, 0, .1F};
  const MotionBank back = reversed(bank);
  const std::vector<double> expected{.1, 0, .9, .9, .1, 0, 0, .9, .1};
  for (std::size_t k = 0; k < 9; ++k) EXPECT_NEAR(back.switching[k], expected[k], 1e-6) << k;
}

}  // namespace
}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/filters/bernoulli.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace glint {
namespace {

// The Bernoulli filter: odds W / (1 - W) L, W = e r.
TEST(Bernoulli, AnUpdateKnowsItsLimits) {
  EXPECT_NEAR(bernoulli_update(0.5, 1, 3), 0.75, 1e-12);
  EXPECT_NEAR(bernoulli_update(0.8, 0.5, 6), 0.8, 1e-12);  // odds 2/3 to 4
  EXPECT_EQ(bernoulli_update(1, 1, 0), 0);
  // Certain of nothing: also a target that cannot die ends, and one given up can come back.
  EXPECT_LT(bernoulli_update(1, 1, 1e-9), 0.01);
  EXPECT_NEAR(bernoulli_update(0, 0.99, 1e80), 0, 1e-12);
  EXPECT_GT(bernoulli_update(bernoulli_update(1, 0.99, 1e-300), 0.99, 1e300), 0.9);
  EXPECT_NEAR(bernoulli_update(0.5, 0.99, 1e300), 1, 1e-12);
}

// P-PHD (14) of one target: mass e n L / (1 + e n L).
TEST(Bernoulli, TheRatioOfAFrameIsInTheMass) {
  const double before = 0.6, survival = 0.9, ratio = 5;
  const double weight = survival * before * ratio;
  EXPECT_NEAR(ratio_of_mass(weight / (1 + weight), before, survival), ratio, 1e-12);
  EXPECT_LT(ratio_of_mass(1.5, before, survival), 1e7);  // of two targets: not infinite
  EXPECT_GT(ratio_of_mass(1.5, before, survival), 1e5);
}

TEST(Bernoulli, NothingIsCertainWhereNoTargetSurvives) {
  const double ratio = ratio_of_mass(0.5, 0.5, 0);
  EXPECT_GT(ratio, 1e50);
  EXPECT_NEAR(bernoulli_update(0.5, 0.9, ratio), 1, 1e-9);
  EXPECT_FALSE(std::isnan(bernoulli_update(0.5, 0, std::numeric_limits<double>::infinity())));
}

}  // namespace
}  // namespace glint

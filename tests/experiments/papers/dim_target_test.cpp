// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "experiments/papers/papers.hpp"

namespace glint {
namespace {

// Eight runs, against bands for twenty.
TEST(DimTarget, MmPhdFindsItAtThreeDecibelsAndNothingInNoise) {
  EXPECT_EQ(expect_in_bands(run_of("dim-target", 8), 1, 8), 7);
}

TEST(Cue, MmPhdHoldsATargetOfThreeDecibelsThatItIsTold) {
  EXPECT_EQ(expect_in_bands(run_of("cue", 8), 1, 8), 2);
}

// Six runs of four scenes, against bands for twenty.
TEST(Consistency, TrackersKnowHowSureTheyMayBe) {
  EXPECT_EQ(expect_in_bands(run_of("consistency", 6), 1, 24), 11);
}

TEST(DimField, MmPfDeclaresEveryPeak) { EXPECT_EQ(expect_in_bands(run_of("dim-field", 1)), 1); }

}  // namespace
}  // namespace glint

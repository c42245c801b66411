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

}  // namespace
}  // namespace glint

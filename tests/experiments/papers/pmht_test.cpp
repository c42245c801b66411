// SPDX-License-Identifier: Apache-2.0
// Experiments of seconds: at their own number of runs, and in the bands that hold for it.
#include <gtest/gtest.h>

#include "experiments/papers/papers.hpp"

namespace glint {
namespace {

void expect_own_bands(const char* experiment, int bands) {
  Workers workers;
  EXPECT_EQ(expect_in_bands(run_experiment(find_experiment(experiment), {}, workers)), bands);
}

TEST(PmhtTable1, EveryFigureIsInItsBand) { expect_own_bands("pmht-table1", 51); }
TEST(PmhtMonteCarlo, EveryFigureIsInItsBand) { expect_own_bands("pmht-montecarlo", 6); }
TEST(MmpfTableA, EveryFigureIsInItsBand) { expect_own_bands("mmpf-tableA", 12); }
TEST(Pmht40Targets, EveryFigureIsInItsBand) { expect_own_bands("pmht-40targets", 2); }

}  // namespace
}  // namespace glint

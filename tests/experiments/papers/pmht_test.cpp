// SPDX-License-Identifier: Apache-2.0
// Experiments of seconds: at their own number of runs, and in the bands that hold for it.
#include <gtest/gtest.h>

#include "glint/experiments/experiment.hpp"

namespace glint {
namespace {

void expect_in_bands(const char* experiment, int bands) {
  Workers workers;
  int banded = 0;
  for (const ExperimentRow& r : run_experiment(find_experiment(experiment), {}, workers).rows) {
    if (!r.band) continue;
    ++banded;
    EXPECT_TRUE(*r.inside()) << r.name << ", " << r.metric << ": " << r.ours;
  }
  EXPECT_EQ(banded, bands);
}

TEST(PmhtTable1, EveryFigureIsInItsBand) { expect_in_bands("pmht-table1", 49); }
TEST(PmhtMonteCarlo, EveryFigureIsInItsBand) { expect_in_bands("pmht-montecarlo", 6); }
TEST(MmpfTableA, EveryFigureIsInItsBand) { expect_in_bands("mmpf-tableA", 12); }
TEST(Pmht40Targets, EveryFigureIsInItsBand) { expect_in_bands("pmht-40targets", 2); }

}  // namespace
}  // namespace glint

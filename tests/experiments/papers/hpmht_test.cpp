// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "experiments/papers/papers.hpp"

namespace glint {
namespace {

TEST(HPmhtTable2, EveryFigureIsInItsBand) {
  int banded = 0;
  for (const ExperimentRow& r : run_of("hpmht-table2", 3).rows) {
    if (!r.band) continue;
    ++banded;
    // Three runs: a tenth of a pixel and one scan of sixty leave room for chance.
    const double slack = r.metric.front() == 'h' ? 2 : 0.3;
    EXPECT_TRUE(r.band->widened(slack).holds(r.ours))
        << r.name << ", " << r.metric << ": " << r.ours;
  }
  EXPECT_EQ(banded, 28);
}

TEST(HPmhtTable3, AThresholdTooLowLosesTheDimTarget) {
  double low = -1, high = -1;
  for (const ExperimentRow& r : run_of("hpmht-table3", 3).rows) {
    if (r.metric.front() != 'h') continue;
    if (r.name == "h-pmht, scenario 4 at .9 I_Th") low = r.ours;
    if (r.name == "h-pmht, scenario 4 at 1.1 I_Th") high = r.ours;
  }
  EXPECT_GE(low, 0);
  EXPECT_LE(low, high - 30);
}

}  // namespace
}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "glint/experiments/experiment.hpp"

namespace glint {
namespace {

constexpr int kRuns = 8;

ExperimentResult short_run_of(const char* experiment) {
  Workers workers;
  ExperimentOptions options;
  options.runs = kRuns;
  options.seed = 7000;
  return run_experiment(find_experiment(experiment), options, workers);
}

/// Errors have a deviation of .2 to .35 px over runs, shares of lost targets one of up to 17 %, or
/// one and a half of forty: these are 3 standard errors of kRuns.
double slack_of(const ExperimentRow& row) {
  if (row.spread == 0 && row.metric.find("lost") == std::string::npos) return 0;
  if (row.metric == "targets lost [%]") return row.name.starts_with("rounded") ? 9 : 18;
  if (row.metric.starts_with("targets lost")) return 1.5;
  return row.metric.starts_with("normalised") ? 0.1 : 0.3;
}

void expect_in_bands(const char* experiment, int bands) {
  int banded = 0;
  for (const ExperimentRow& r : short_run_of(experiment).rows) {
    if (!r.band) continue;
    ++banded;
    const double slack = slack_of(r);
    const Band widened{r.band->low ? std::optional(*r.band->low - slack) : std::nullopt,
                       r.band->high ? std::optional(*r.band->high + slack) : std::nullopt};
    EXPECT_TRUE(widened.holds(r.ours)) << r.name << ", " << r.metric << ": " << r.ours;
  }
  EXPECT_EQ(banded, bands);
}

TEST(PmhtTable1, EveryFigureIsInItsBand) { expect_in_bands("pmht-table1", 49); }
TEST(PmhtMonteCarlo, EveryFigureIsInItsBand) { expect_in_bands("pmht-montecarlo", 6); }
TEST(MmpfTableA, EveryFigureIsInItsBand) { expect_in_bands("mmpf-tableA", 12); }
TEST(Pmht40Targets, EveryFigureIsInItsBand) { expect_in_bands("pmht-40targets", 2); }

}  // namespace
}  // namespace glint

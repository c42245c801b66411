// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "glint/experiments/experiment.hpp"

namespace glint {

/// A run of `runs` runs, on seeds that `glint experiment` does not use by default.
inline ExperimentResult run_of(const char* experiment, int runs) {
  Workers workers;
  ExperimentOptions options;
  options.runs = runs, options.seed = 5000;
  return run_experiment(find_experiment(experiment), options, workers);
}

/// The number of figures with a band; those outside by more than `errors` standard errors of a mean
/// of `runs` fail.
inline int expect_in_bands(const ExperimentResult& result, double errors = 0, int runs = 1) {
  int banded = 0;
  for (const ExperimentRow& r : result.rows) {
    if (!r.band) continue;
    ++banded;
    const double slack = errors > 0 ? errors * r.spread / std::sqrt(runs) : 0;
    EXPECT_TRUE(r.band->widened(slack).holds(r.ours))
        << r.name << ", " << r.metric << ": " << r.ours;
  }
  return banded;
}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "egl.hpp"

#include <gtest/gtest.h>

#include "experiments/papers/papers.hpp"

namespace glint {
namespace {

/// The experiment on the egl device, on seeds that `glint experiment` does not use by default.
ExperimentResult run_on(const Device& device, const char* experiment, int runs) {
  Workers workers(1);
  ExperimentOptions options;
  options.runs = runs;
  options.seed = 5000;
  options.device = device;
  return run_experiment(find_experiment(experiment), options, workers);
}

// smc-phd, mm-phd, mm-pf, viterbi and h-pmht.
TEST(EglPapers, PhdSection53IsInItsBands) {
  GLINT_NEEDS_EGL(device);
  EXPECT_EQ(expect_in_bands(run_on(device, "phd-5.3", 2)), 11);
}

TEST(EglPapers, HPmhtTable2IsInItsBands) {
  GLINT_NEEDS_EGL(device);
  EXPECT_EQ(expect_in_bands(run_on(device, "hpmht-table2", 1)), 28);
}

}  // namespace
}  // namespace glint

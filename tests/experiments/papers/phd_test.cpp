// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "experiments/papers/papers.hpp"

namespace glint {
namespace {

constexpr int kRuns = 12;

const ExperimentResult& short_run() {
  static const ExperimentResult kResult = run_of("phd-5.1", kRuns);
  return kResult;
}

const ExperimentRow& row(const ExperimentResult& result, const std::string& name,
                         const std::string& metric) {
  for (const ExperimentRow& r : result.rows) {
    if (r.name == name && r.metric == metric) return r;
  }
  throw std::runtime_error("no row " + name + ", " + metric);
}
const ExperimentRow& row(const std::string& name, const std::string& metric) {
  return row(short_run(), name, metric);
}

double ospa_of(const std::string& name) { return row(name, "OSPA while present [px]").ours; }

TEST(PhdSection51, EveryFigureIsInItsBandWithinThreeStandardErrors) {
  EXPECT_EQ(expect_in_bands(short_run(), 3, kRuns), 31);
}

TEST(PhdSection51, TwoFrameBirthBeatsUniformBirth) {
  for (const std::string level : {"12 dB", "10 dB", "8 dB"}) {
    EXPECT_LE(ospa_of("two-frame, " + level), ospa_of("standard, " + level) - 0.3) << level;
  }
}

TEST(PhdSection51, TheFormulasAsPrintedFail) {
  for (const std::string level : {"12 dB", "10 dB", "8 dB"}) {
    EXPECT_GE(ospa_of("literal standard, " + level), 4.2) << level;
    EXPECT_GE(row("literal standard, " + level, "n, frames 15-24").ours, 3) << level;
  }
}

TEST(PhdSection51, ErrorsStayBelowThePixelAndGrowAsTheTargetDims) {
  double last = 0;
  for (const std::string level : {"12 dB", "10 dB", "8 dB"}) {
    EXPECT_LE(row("two-frame, " + level, "RMSE [px]").ours, 0.95) << level;
    EXPECT_GE(ospa_of("two-frame, " + level), last) << level;
    last = ospa_of("two-frame, " + level);
  }
}

TEST(PhdSection51, TheImprovedTrackerBeatsTheStandardOne) {
  EXPECT_LE(ospa_of("improved, 10 dB"), ospa_of("standard, 10 dB") - 0.25);
}

TEST(PhdSection52, EveryFigureIsInItsBandWithinThreeStandardErrors) {
  EXPECT_EQ(expect_in_bands(run_of("phd-5.2", kRuns), 3, kRuns), 10);
}

TEST(PhdSection53, EveryFigureIsInItsBandWithinThreeStandardErrors) {
  EXPECT_GE(expect_in_bands(run_of("phd-5.3", kRuns), 3, kRuns), 8);
}

}  // namespace
}  // namespace glint

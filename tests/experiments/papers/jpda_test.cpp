// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "experiments/papers/papers.hpp"

namespace glint {
namespace {

double figure(const ExperimentResult& result, const std::string& name, const std::string& metric) {
  for (const ExperimentRow& row : result.rows) {
    if (row.name == name && row.metric == metric) return row.ours;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

// Means hang on the few tracks that are lost, so they are judged by the median and by loss.
TEST(JpdaFig2, AWindowLosesFewerTracksThanASingleScan) {
  const ExperimentResult result = run_of("jpda-fig2", 200);
  const char* lost = "tracks lost [%]";
  for (const char* reading : {"single scan", "A", "C", "C*"}) {
    const double median = figure(result, reading, "its median [m]");
    EXPECT_TRUE(median > 70 && median < 79) << reading << ": " << median;
  }
  EXPECT_LT(figure(result, "single scan", lost), 2.5);
  EXPECT_LE(figure(result, "C*", lost), 0.5);
  EXPECT_LE(figure(result, "C*", lost), figure(result, "single scan", lost));
  EXPECT_LT(figure(result, "C*", "ln of rms over single scan"), 0);
  EXPECT_EQ(result.curves.size(), 4u);
}

TEST(JpdaCoalescence, TheBestPermutationBringsMergedTargetsApart) {
  const ExperimentResult result = run_of("jpda-coalescence", 40);
  EXPECT_TRUE(bands_hold(result));
  for (const std::string parting : {", parting at 0.3", ", parting at 1.2"}) {
    const char* after = "OSPA after [m]";
    const double best = figure(result, "C*" + parting, after);
    EXPECT_LT(best, figure(result, "C" + parting, after) - 3) << parting;
    EXPECT_LT(best, figure(result, "single scan" + parting, after)) << parting;
  }
  EXPECT_GT(figure(result, "C, parting at 1.2", "runs lost [%]"), 30);
}

}  // namespace
}  // namespace glint

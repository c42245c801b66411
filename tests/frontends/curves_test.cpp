// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/cli/curves.hpp"

#include <gtest/gtest.h>

namespace glint::cli {
namespace {

Curve curve(std::string level, std::string condition, std::string metric) {
  return {std::move(level), std::move(condition), std::move(metric), {1, 2}, {0.5, 1}};
}

TEST(Curves, PlotHasARowAMetricAndNoPanelWithoutCurves) {
  ExperimentResult result;
  result.curves = {curve("all targets", "a", "ospa"), curve("target 1", "a", "rmse"),
                   curve("all targets", "b", "ospa"), curve("target 2", "a", "rmse"),
                   curve("target 1", "b", "rmse")};
  const std::vector<PlotRow> rows = plot_of(result);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].y_label, "OSPA [px]");
  ASSERT_EQ(rows[0].panels.size(), 1u);
  EXPECT_EQ(rows[0].panels[0].title, "all targets");
  EXPECT_EQ(rows[0].panels[0].lines.size(), 2u);
  ASSERT_EQ(rows[1].panels.size(), 2u);
  EXPECT_EQ(rows[1].panels[0].lines.size(), 2u);
  EXPECT_EQ(rows[1].panels[1].title, "target 2");
  EXPECT_EQ(rows[1].panels[1].lines.size(), 1u);
}

TEST(Curves, AMetricUnknownToThePlotKeepsItsName) {
  ExperimentResult result;
  result.curves = {curve("", "a", "delay")};
  EXPECT_EQ(plot_of(result)[0].y_label, "delay");
  EXPECT_TRUE(plot_of(ExperimentResult{}).empty());
}

}  // namespace
}  // namespace glint::cli

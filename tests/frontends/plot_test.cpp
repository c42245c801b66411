// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/video/plot.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/imgcodecs.hpp>

#include "folder.hpp"
#include "glint/frontends/video/plot_panel.hpp"

namespace glint {
namespace {

using test::Folder;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

PlotRow row_of(int panels, const std::vector<std::string>& labels) {
  PlotRow row{"frame", "OSPA [px]", false, {}};
  for (int p = 0; p < panels; ++p) {
    PlotPanel panel{"panel", {}};
    for (const std::string& label : labels) panel.lines.push_back({label, {1, 2, 3}, {1, 3, 2}});
    row.panels.push_back(panel);
  }
  return row;
}

cv::Mat picture_of(const std::vector<PlotRow>& rows) {
  const Folder folder;
  write_plot(folder / "p.png", rows);
  return cv::imread(folder / "p.png");
}

int inked(const cv::Mat& part) { return cv::countNonZero(part.reshape(1) != 255); }

TEST(Plot, LegendsLieInsideThePicture) {
  const std::string longer(40, 'm');
  std::vector<std::string> labels;
  for (int i = 0; i < 9; ++i) labels.push_back(longer + std::to_string(i));
  const std::string longest(90, 'm');
  labels.push_back(longest);
  const cv::Mat picture = picture_of({row_of(2, labels), row_of(1, {"short"})});
  EXPECT_GT(picture.cols, text_width(longest));
  EXPECT_EQ(inked(picture.colRange(picture.cols - 10, picture.cols)), 0);
  EXPECT_EQ(inked(picture.rowRange(picture.rows - 4, picture.rows)), 0);
}

TEST(Plot, EveryLegendIsDrawn) {
  const int one = picture_of({row_of(1, {"a"})}).rows;
  const std::string label(60, 'm');
  const cv::Mat two = picture_of({row_of(1, {label + "1", label + "2"})});
  EXPECT_GT(two.rows, one);  // one below the other
  const int top = two.rows - 24;
  EXPECT_GT(inked(two.rowRange(top, two.rows)), 500);
}

TEST(Plot, PanelsOfARowFillThePictureAndWrapAfterFour) {
  const cv::Mat picture = picture_of({row_of(6, {"a"}), row_of(1, {"a"})});
  EXPECT_EQ(picture.cols, 3 * 440);
  EXPECT_EQ(picture.rows, 3 * 300 + 2 * 36);
  EXPECT_GT(inked(picture(cv::Rect(900, 636, 400, 250))), 500);  // the lone panel's right part
}

TEST(Plot, AxesHoldAllLinesOfARow) {
  PlotRow row = row_of(2, {"a"});
  row.panels[1].lines[0] = {"a", {1, 42}, {kNaN, 7.3}};
  const PlotAxes axes = axes_of(row);
  EXPECT_DOUBLE_EQ(axes.x.last, 42);
  EXPECT_DOUBLE_EQ(axes.y.last, 8);
  EXPECT_EQ(axes.y.ticks(), (std::vector<double>{0, 2, 4, 6, 8}));
  EXPECT_DOUBLE_EQ(axes.x.ticks().back(), 40);
  EXPECT_DOUBLE_EQ(axes.x.place(21), 0.5);
}

TEST(Plot, LogarithmicAxesHaveAtMostFourDecades) {
  PlotRow row{"frame", "n", true, {{"", {{"a", {1, 2, 3}, {0, 2e-9, 15}}}}}};
  const PlotAxis wide = axes_of(row).y;
  EXPECT_NEAR(wide.first, 0.01, 1e-12);
  EXPECT_NEAR(wide.last, 100, 1e-9);
  EXPECT_EQ(wide.ticks().size(), 5u);
  EXPECT_NEAR(wide.place(1), 0.5, 1e-12);
  EXPECT_DOUBLE_EQ(wide.place(0), 0);
  row.panels[0].lines[0].y = {1, 1, 1};
  EXPECT_LT(axes_of(row).y.first, axes_of(row).y.last);
}

TEST(Plot, LinesOfOneLabelAreAlikeAndNoTwoLabelsAre) {
  for (std::size_t a = 0; a < 14; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const PlotStyle one = plot_style(a), two = plot_style(b);
      EXPECT_FALSE(one.colour == two.colour && one.dashed == two.dashed) << a << ", " << b;
    }
  }
}

TEST(Plot, APointBetweenGapsIsDrawn) {
  const auto first_colour = [](const PlotRow& row) {
    cv::Mat mask;
    const cv::Scalar colour = plot_style(0).colour;
    cv::inRange(picture_of({row}), colour, colour, mask);
    return cv::countNonZero(mask);
  };
  PlotRow row = row_of(1, {"a"});
  row.panels[0].lines[0].y = {kNaN, kNaN, kNaN};
  const int legend = first_colour(row);
  EXPECT_GT(legend, 0);
  row.panels[0].lines[0].y = {kNaN, 3, kNaN};
  EXPECT_GT(first_colour(row), legend + 4);
  row.panels[0].lines[0] = {"a", {}, {}};
  EXPECT_EQ(first_colour(row), legend);
}

TEST(Plot, UnwritablePathsAreNamed) {
  const Folder folder;
  const std::vector<PlotRow> rows{row_of(1, {"a"})};
  EXPECT_THROW(write_plot(folder / "no/p.png", rows), std::runtime_error);
}

}  // namespace
}  // namespace glint

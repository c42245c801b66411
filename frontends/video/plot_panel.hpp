// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "glint/frontends/video/plot.hpp"
#include "glint/frontends/video/plot_axes.hpp"

namespace glint {

struct PlotStyle {
  cv::Scalar colour;
  bool dashed = false;
};

/// How the line with the number `index` is drawn.
PlotStyle plot_style(std::size_t index);

/// A text whose base line begins at `at`; `align` 0.5 centres it there, 1 ends it there.
void write_text(cv::Mat& image, const std::string& text, cv::Point at, double align = 0);
int text_width(const std::string& text);  ///< [px]

/// Goes from `at` to `to` and returns the dash's length so far; `gone` is that of the line before.
double draw_stroke(cv::Mat& image, cv::Point2d at, cv::Point2d to, const PlotStyle& style,
                   double gone = 0);

/// Draws a panel that fills `part`, lines in the order and style of `labels`.
void draw_panel(const cv::Mat& part, const PlotRow& row, const PlotPanel& panel,
                const PlotAxes& axes, const std::vector<std::string>& labels);

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <string>
#include <vector>

namespace glint {

/// A line of a plot; NaN breaks it.
struct PlotLine {
  std::string label;
  std::vector<double> x, y;
};

struct PlotPanel {
  std::string title;
  std::vector<PlotLine> lines;
};

/// Panels that show the same quantity on the same scales.
struct PlotRow {
  std::string x_label, y_label;  ///< with units
  bool logarithmic = false;      ///< y in decades, at most four; what is less lies on the axis
  std::vector<PlotPanel> panels;
};

/// Draws the rows one below the other, each as wide as the picture and with a legend of its lines
/// below; axes from 0 unless logarithmic. More than four panels make a second line. Equal labels
/// have equal colours in the whole picture; from the eighth on, lines are dashed. Writes a PNG;
/// throws std::runtime_error if it cannot.
void write_plot(const std::string& path, std::span<const PlotRow> rows);

}  // namespace glint

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
  std::string title, x_label, y_label;
  std::vector<PlotLine> lines;
};

/// Draws panels row by row, `columns` to a row, with axes from 0, ticks, and one legend for all
/// below: equal labels have equal colours. Writes a PNG; throws std::runtime_error if it cannot.
void write_plot(const std::string& path, std::span<const PlotPanel> panels, int columns);

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "glint/frontends/video/plot.hpp"

namespace glint {

struct PlotAxis {
  double first = 0, last = 1, step = 0.2;  ///< a tick every `step`
  bool logarithmic = false;                ///< ticks at powers of ten instead

  double place(double value) const;  ///< 0 at `first`, 1 at `last`
  std::vector<double> ticks() const;
};

struct PlotAxes {
  PlotAxis x, y;
};

/// Axes that hold all lines of a row.
PlotAxes axes_of(const PlotRow& row);

}  // namespace glint

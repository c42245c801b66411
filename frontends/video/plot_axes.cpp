// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/video/plot_axes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace glint {
namespace {

constexpr double kMostDecades = 4;

/// 1, 2 or 5 times a power of ten, so that about five steps make up `range`.
double tick_step(double range) {
  const double rough = range / 5, power = std::pow(10, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough) return factor * power;
  }
  return 10 * power;
}

struct Extent {
  double least = std::numeric_limits<double>::infinity();  // above 0
  double most = 0;
};

Extent extent_of(const PlotRow& row, std::vector<double> PlotLine::*values) {
  Extent extent;
  for (const PlotPanel& panel : row.panels) {
    for (const PlotLine& line : panel.lines) {
      for (const double v : line.*values) {
        if (!(v > 0)) continue;  // NaN too
        extent.least = std::min(extent.least, v), extent.most = std::max(extent.most, v);
      }
    }
  }
  return extent;
}

}  // namespace

double PlotAxis::place(double value) const {
  if (!logarithmic) return (value - first) / (last - first);
  return std::log(std::max(value, first) / first) / std::log(last / first);
}

std::vector<double> PlotAxis::ticks() const {
  std::vector<double> ticks;
  const double rounding = 1 + 1e-9;
  if (logarithmic) {
    for (double tick = first; tick <= last * rounding; tick *= 10) ticks.push_back(tick);
  } else {
    for (int i = 0; i * step <= last * rounding; ++i) ticks.push_back(i * step);
  }
  return ticks;
}

PlotAxes axes_of(const PlotRow& row) {
  PlotAxes axes;
  const Extent x = extent_of(row, &PlotLine::x), y = extent_of(row, &PlotLine::y);
  if (x.most > 0) axes.x.last = x.most, axes.x.step = tick_step(x.most);
  if (row.logarithmic) {
    const double last = y.most > 0 ? std::ceil(std::log10(y.most) - 1e-9) : 0;
    const double first = y.most > 0 ? std::floor(std::log10(y.least)) : -1;
    const double lowest = std::clamp(first, last - kMostDecades, last - 1);
    axes.y = {std::pow(10, lowest), std::pow(10, last), 1, true};
  } else if (y.most > 0) {
    axes.y.step = tick_step(y.most);
    axes.y.last = axes.y.step * std::ceil(y.most / axes.y.step - 1e-9);
  }
  return axes;
}

}  // namespace glint

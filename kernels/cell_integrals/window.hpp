// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>

#include "glint/kernels/cell_integrals/cell_integrals.hpp"

namespace glint::cell_integrals {

/// Throws std::invalid_argument for what CellIntegrals does not take.
void check(const CellIntegrals::Args& args);

/// S.
inline double cells_of(const CellIntegrals::Args& args) {
  return args.cells > 0 ? args.cells : static_cast<double>(args.frame.width) * args.frame.height;
}

/// Cells [begin, end) of one axis of `length` pixels that a target's window covers.
struct Span {
  int begin = 0, end = 0;
};
inline Span window_span(double mean, double sigma, double reach, int length) {
  const double centre = std::floor(mean + 0.5), half = std::ceil(reach * sigma);
  const double begin = centre - half, end = centre + half + 1;
  if (!(begin < length && end > 0)) return {};
  return {begin > 0 ? static_cast<int>(begin) : 0, end < length ? static_cast<int>(end) : length};
}

/// Window of a target, clipped to the frame; empty if nothing is left of it.
inline Box window_of(const HistogramTarget& t, const CellIntegrals::Args& args) {
  const Span x = window_span(t.x, t.sigma_x, args.reach, args.frame.width);
  const Span y = window_span(t.y, t.sigma_y, args.reach, args.frame.height);
  if (x.begin >= x.end || y.begin >= y.end) return {};
  return {x.begin, y.begin, x.end, y.end};
}

/// A target's sums before the frame's totals are known: over displayed cells with weights
/// z_l / P_l, and over cells without data with weight 1. Moments are about the target's mean.
struct PartialSums {
  double count = 0, x = 0, y = 0, xx = 0, yy = 0;
  double missing = 0, missing_x = 0, missing_y = 0, missing_xx = 0, missing_yy = 0;
  double probability = 0;  ///< sum of P_kl over all cells of the window
};

/// Adds what (9) expects of cells without data, and normalises. `partial` one a target.
void finish(const CellIntegrals::Args& args, std::span<const PartialSums> partial,
            double log_ratio_sum);

}  // namespace glint::cell_integrals

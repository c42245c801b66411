// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/kernels/cell_integrals/cell_integrals.hpp"
#include "glint/kernels/core/inline.hpp"

namespace glint::cell_integrals {

/// Throws std::invalid_argument for what CellIntegrals does not take.
void check(const CellIntegrals::Args& args);

/// S.
inline double cells_of(const CellIntegrals::Args& args) {
  return args.cells > 0 ? args.cells : static_cast<double>(args.frame.width) * args.frame.height;
}

/// Cells [begin, end) of one axis.
struct Stretch {
  int begin = 0, end = 0;
};
/// What a target's window covers of an axis of `length` pixels; empty for a mean that is NaN.
GLINT_INLINE Stretch stretch_of(double mean, double sigma, double reach, int length) {
  const double centre = __builtin_floor(mean + 0.5), half = __builtin_ceil(reach * sigma);
  const double begin = centre - half, end = centre + half + 1;
  if (!(begin < length && end > 0)) return {};
  return {begin > 0 ? static_cast<int>(begin) : 0, end < length ? static_cast<int>(end) : length};
}
/// Window of a target, clipped to the frame; all zeros if nothing is left of it.
GLINT_INLINE Box window_of(const HistogramTarget& t, double reach, int width, int height) {
  const Stretch x = stretch_of(t.x, t.sigma_x, reach, width);
  const Stretch y = stretch_of(t.y, t.sigma_y, reach, height);
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

/// What holds for all targets of a frame once all partial sums are there.
struct Totals {
  double shown = 0, missing = 0;  ///< probability of the cells with and without data
  double missing_weight = 0;      ///< expected measurements a unit of probability without data
};
Totals totals_of(const CellIntegrals::Args& args, std::span<const PartialSums> partial);

/// Adds what P-HPMHT (9) expects of cells without data, and normalises.
TargetSums normalised(const HistogramTarget& t, const PartialSums& p, double missing_weight);

/// Fills args.mixture, if given, when args.sums are final.
void fill_mixture(const CellIntegrals::Args& args, const Totals& totals, double log_ratio_sum);

}  // namespace glint::cell_integrals

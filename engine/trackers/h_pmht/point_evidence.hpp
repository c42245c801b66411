// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>

#include "glint/kernels/core/frame.hpp"
#include "glint/kernels/core/point_spread.hpp"

namespace glint {

/// Where a target is expected: independent Gaussians along the axes.
struct ExpectedPlace {
  double x = 0, y = 0;          ///< [px]
  double var_x = 0, var_y = 0;  ///< [px^2]
};

/// Likelihood ratio of the whitened frame `z` with a point target against noise alone, P-PHD (13),
/// averaged over the pixels where the target may be and over `intensities` [noise sigmas]. What
/// lies outside the frame shows nothing: 0.
double mean_likelihood_ratio(FrameView z, const PointSpread& spread,
                             std::span<const double> intensities, const ExpectedPlace& place);

}  // namespace glint

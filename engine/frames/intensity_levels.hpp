// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "glint/kernels/core/frame.hpp"

namespace glint {

/// Levels of a frame's pixels, NaN left out; zeros if there are none.
struct IntensityLevels {
  double mean = 0;
  double high = 0;  ///< exceeded by one pixel in a thousand

  /// The intensity above which a cell is displayed. P-HPMHT (23), whose maximum one black pixel
  /// sets; hence the quantile.
  double displayed() const { return mean + 0.1 * high; }
};

/// `workspace` is memory to be used again.
IntensityLevels intensity_levels(FrameView frame, std::vector<float>& workspace);

/// What half of `values` lie below, and 1.4826 times the same of their distance from it, the
/// standard deviation if they are normal but for outliers. Reorders `values`; zeros if empty.
struct RobustMoments {
  double median = 0, sigma = 0;
};
RobustMoments robust_moments(std::vector<float>& values);

}  // namespace glint

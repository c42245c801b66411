// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "glint/kernels/core/device.hpp"
#include "glint/kernels/core/frame.hpp"
#include "glint/kernels/core/point_spread.hpp"

namespace glint {

/// What a single frame shows by itself: the frame correlated with the point spread, in units of the
/// noise of the result. The baseline of track-before-detect.
class MatchedFilter {
 public:
  /// `psf_sigma` [px]; throws std::invalid_argument unless PointSpread::of() takes it.
  MatchedFilter(double psf_sigma, const Device& device);
  /// Sum of h z over the root of the sum of h^2, h the point spread at the pixel's centre, both
  /// sums clipped at the border: unit noise in, unit noise out. Valid until the next call.
  FrameView response(FrameView whitened);

 private:
  Device device_;
  PointSpread spread_;
  Image<float> response_;
  std::vector<float> energy_x_, energy_y_;  ///< sum of squared weights inside the frame, by pixel
};

}  // namespace glint

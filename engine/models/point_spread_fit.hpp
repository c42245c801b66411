// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/kernels/core/frame.hpp"

namespace glint {

/// Point spread sigma [px] that explains the brightest local maxima of a whitened frame best: the
/// one of the largest matched-filter energy A^2 / B, summed over up to 20 maxima above 5 sigma. 1.0
/// if there is none.
double fit_point_spread(FrameView z);

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>

#include "glint/kernels/core/frame.hpp"

namespace glint {

/// Point spread sigma [px] that explains the brightest local maxima best: the one of the largest
/// matched-filter energy A^2 / B, summed over up to 20 maxima of `whitened` above 6 sigma. Their
/// shape is taken from `raw`, less the level around them, since whitened frames are clipped; from
/// `whitened` if there is no raw frame. Nothing if there is no such maximum.
std::optional<double> fit_point_spread(FrameView whitened, FrameView raw);

}  // namespace glint

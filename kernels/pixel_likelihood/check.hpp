// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <stdexcept>

#include "glint/kernels/pixel_likelihood/pixel_likelihood.hpp"

namespace glint::pixel_likelihood {

/// Throws std::invalid_argument for a map of another size than the frame's or a window that no
/// kernel takes.
inline void check(const PixelLikelihood::Args& args) {
  const auto [width, height] = std::visit(
      [](const auto& frame) {
        return std::pair{frame.width, frame.height};
      },
      args.frame);
  if (!args.map.empty() && (args.map.width != width || args.map.height != height)) {
    throw std::invalid_argument("the likelihood map must have the size of the frame");
  }
  if (args.spread.half_width < 0 || args.spread.half_width > kMaxHalfWidth ||
      !(args.spread.sigma > 0)) {
    throw std::invalid_argument(
        "the point spread needs sigma > 0 and a half width of 0 to 7 pixels");
  }
}

}  // namespace glint::pixel_likelihood

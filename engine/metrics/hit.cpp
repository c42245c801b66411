// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/metrics/hit.hpp"

#include <cmath>
#include <cstddef>

namespace glint {

bool hits(const Position& estimate, const Patch& target) {
  const double x = std::round(estimate.x), y = std::round(estimate.y);
  const Box& box = target.box;
  // NaN and what is too far for an int are outside of any box.
  if (!(x >= box.x0 && x < box.x1 && y >= box.y0 && y < box.y1)) return false;
  const auto row = static_cast<std::size_t>(y - box.y0),
             column = static_cast<std::size_t>(x - box.x0);
  return target.share[row * static_cast<std::size_t>(box.x1 - box.x0) + column] >= 0.5F;
}

}  // namespace glint

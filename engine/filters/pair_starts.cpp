// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/filters/pair_starts.hpp"

#include <algorithm>
#include <tuple>

namespace glint {

std::span<const PairStart> PairStarts::find(std::span<const Point> before,
                                            std::span<const Point> now, double reach) {
  pairs_.clear();
  // Rows of pixels are in order, rows of sub-pixel maxima only within a pixel.
  const double rows = reach + 1;
  std::size_t first = 0;
  for (const Point& b : now) {
    while (first < before.size() && before[first].y < b.y - rows - 1) ++first;
    for (std::size_t i = first; i < before.size() && before[i].y <= b.y + rows; ++i) {
      const Point& a = before[i];
      const double dx = b.x - a.x, dy = b.y - a.y;
      if (dx * dx + dy * dy > reach * reach) continue;
      pairs_.push_back({b.x, b.y, a.x, a.y, static_cast<double>(a.amplitude) + b.amplitude});
    }
  }
  std::sort(pairs_.begin(), pairs_.end(), [](const PairStart& a, const PairStart& b) {
    return std::tie(b.score, a.y, a.x, a.before_y, a.before_x) <
           std::tie(a.score, b.y, b.x, b.before_y, b.before_x);
  });
  return pairs_;
}

}  // namespace glint

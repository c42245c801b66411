// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/cell_integrals/neighbours.hpp"

namespace glint::cell_integrals {

void Grid::sort(const std::vector<LaneTarget>& targets, int width, int height,
                std::vector<LaneTarget>& sorted) {
  int side = 1;
  for (const LaneTarget& t : targets) {
    side = std::max({side, t.box.x1 - t.box.x0, t.box.y1 - t.box.y0});
  }
  reach_ = side - 1;
  const auto squares = [&] {
    return static_cast<std::size_t>((width >> shift_) + 1) *
           static_cast<std::size_t>((height >> shift_) + 1);
  };
  for (shift_ = 5; (1 << shift_) < side || squares() > 4 * targets.size() + 1;) ++shift_;
  columns_ = (width >> shift_) + 1, rows_ = (height >> shift_) + 1;
  // Counting sort: start_[s + 2] counts square s, start_[s + 1] is the place of its next target.
  start_.assign(squares() + 2, 0);
  for (const LaneTarget& t : targets) ++start_[square(t.box) + 2];
  for (std::size_t s = 2; s < start_.size(); ++s) start_[s] += start_[s - 1];
  sorted.resize(targets.size());
  for (const LaneTarget& t : targets) sorted[start_[square(t.box) + 1]++] = t;
}

}  // namespace glint::cell_integrals

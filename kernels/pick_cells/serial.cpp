// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "glint/kernels/core/cells.hpp"
#include "glint/kernels/pick_cells/pick_cells.hpp"

namespace glint {
namespace {

struct Picked {
  int x, y;
  double total;
};

Picked pick(FrameView score, int reach, Pixel centre, double u) {
  const int x0 = std::max(0, centre.x - reach), x1 = std::min(score.width - 1, centre.x + reach);
  const int y0 = std::max(0, centre.y - reach), y1 = std::min(score.height - 1, centre.y + reach);
  const auto row_sum = [&](int y) {
    return std::accumulate(score.row(y) + x0, score.row(y) + x1 + 1, 0.0);
  };
  double total = 0;
  for (int y = y0; y <= y1; ++y) total += row_sum(y);
  double left = u * total;
  int y = y0;
  for (double s = row_sum(y); y < y1 && left >= s; s = row_sum(y)) left -= s, ++y;
  int x = x0;
  for (; x < x1 && left >= score(x, y); ++x) left -= score(x, y);
  return {x, y, total};
}

}  // namespace

void pick_cells::check(const PickCells::Args& args) {
  const std::size_t n = args.cell.size();
  if (args.uniform.size() != n || args.picked.size() != n || args.picked_score.size() != n ||
      args.total.size() != n) {
    throw std::invalid_argument("pick_cells needs arrays of one length");
  }
  if (args.reach < 0) throw std::invalid_argument("the reach must not be negative");
  const auto cells =
      static_cast<std::uint64_t>(args.score.width) * static_cast<std::uint64_t>(args.score.height);
  if (std::ranges::any_of(args.cell, [&](std::uint32_t cell) { return cell >= cells; })) {
    throw std::invalid_argument("a cell lies beyond the frame");
  }
}

void PickCells::serial(const Args& args) {
  pick_cells::check(args);
  for (std::size_t i = 0; i < args.cell.size(); ++i) {
    const Pixel centre = pixel_at(args.cell[i], args.score.width);
    const Picked found = pick(args.score, args.reach, centre, static_cast<double>(args.uniform[i]));
    args.picked[i] = cell_at(found.x, found.y, args.score.width);
    args.picked_score[i] = args.score(found.x, found.y);
    args.total[i] = found.total;
  }
}

}  // namespace glint

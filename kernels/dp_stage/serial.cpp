// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>
#include <stdexcept>

#include "glint/kernels/dp_stage/dp_stage.hpp"

namespace glint {

void dp_stage::check(const DpStage::Args& a) {
  const auto fits = [&](const auto& view) {
    return view.width == a.score.width && view.height == a.score.height;
  };
  if (!fits(a.before) || !fits(a.total) || !fits(a.dx) || !fits(a.dy) ||
      (!a.moves.empty() && (!fits(a.moves.dx) || !fits(a.moves.dy)))) {
    throw std::invalid_argument("all images of a stage must have the size of its scores");
  }
  if (a.reach < 0 || a.reach > kMaxDpReach || a.tolerance < 0) {
    throw std::invalid_argument("a stage needs a reach of 0 to 63 pixels and a tolerance >= 0");
  }
}

namespace {

/// May the best path to (x, y) go on by (dx, dy)?
bool may_follow(const DpStage::Args& a, int x, int y, int dx, int dy) {
  return a.moves.empty() || (std::abs(dx - a.moves.dx(x, y)) <= a.tolerance &&
                             std::abs(dy - a.moves.dy(x, y)) <= a.tolerance);
}

void reach_cell(const DpStage::Args& a, int x, int y) {
  double best = -std::numeric_limits<double>::infinity();
  int best_dx = 0, best_dy = 0;
  for (int dy = -a.reach; dy <= a.reach; ++dy) {
    for (int dx = -a.reach; dx <= a.reach; ++dx) {
      if (!a.before.contains(x - dx, y - dy)) continue;
      const double before = a.before(x - dx, y - dy);
      if (!(before > best) || !may_follow(a, x - dx, y - dy, dx, dy)) continue;
      best = before, best_dx = dx, best_dy = dy;
    }
  }
  a.total(x, y) = static_cast<float>(a.score(x, y) + best);
  a.dx(x, y) = static_cast<std::int8_t>(best_dx);
  a.dy(x, y) = static_cast<std::int8_t>(best_dy);
}

}  // namespace

void DpStage::serial(const Args& a) {
  dp_stage::check(a);
  for (int y = 0; y < a.score.height; ++y) {
    for (int x = 0; x < a.score.width; ++x) reach_cell(a, x, y);
  }
}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cmath>

#include "glint/kernels/prepare_frame/registration.hpp"

namespace glint {

/// Sums of one Gauss-Newton step: gradient products, and gradient times residual.
struct NormalEquations {
  double xx = 0, xy = 0, yy = 0, xe = 0, ye = 0;
};

/// Large frames are looked at in every so many rows only: about 2^18 pixels say enough.
inline int row_step(int width, int height) {
  return std::max<int>(1, static_cast<int>(static_cast<double>(width) * height / 0x1p18));
}

/// The search that the reference and the fast path of EstimateShift share. They differ in how they
/// sum: `difference(reference, moving, dx, dy)` is a mean absolute difference, `equations(...)`
/// gives the NormalEquations of the same arguments.
template <class Difference, class Equations>
Shift search_shift(const EstimateShift::Args& args, const Difference& difference,
                   const Equations& equations) {
  constexpr int kSteps = 12;
  constexpr double kConverged = 1e-3;  // [px]
  const FrameView reference = args.reference[0], moving = args.moving[0];
  Shift best;
  best.unshifted = best.shifted = difference(reference, moving, 0, 0);
  const int levels = static_cast<int>(std::min(args.reference.size(), args.moving.size()));
  int cx = 0, cy = 0;
  for (int level = levels - 1; level >= 0; --level) {
    const FrameView r = args.reference[static_cast<std::size_t>(level)];
    const FrameView m = args.moving[static_cast<std::size_t>(level)];
    const int reach_x = level == levels - 1 ? std::min(args.max_shift >> level, r.width / 4) : 1;
    const int reach_y = level == levels - 1 ? std::min(args.max_shift >> level, r.height / 4) : 1;
    cx *= 2, cy *= 2;
    int at_x = cx, at_y = cy;
    double least = difference(r, m, cx, cy);
    for (int j = cy - reach_y; j <= cy + reach_y; ++j) {
      for (int i = cx - reach_x; i <= cx + reach_x; ++i) {
        const double d = difference(r, m, i, j);
        if (d < least) least = d, at_x = i, at_y = j;
      }
    }
    cx = at_x, cy = at_y;
  }
  double dx = cx, dy = cy;
  for (int step = 0; step < kSteps; ++step) {
    const NormalEquations n = equations(reference, moving, dx, dy);
    const double det = n.xx * n.yy - n.xy * n.xy;
    if (!(det > 1e-9 * n.xx * n.yy) || n.xx * n.yy <= 0) break;
    const double mx = -(n.yy * n.xe - n.xy * n.ye) / det;
    const double my = -(n.xx * n.ye - n.xy * n.xe) / det;
    dx = std::clamp(dx + mx, cx - 1.5, cx + 1.5);
    dy = std::clamp(dy + my, cy - 1.5, cy + 1.5);
    if (std::abs(mx) < kConverged && std::abs(my) < kConverged) break;
  }
  best.dx = dx, best.dy = dy;
  best.shifted = difference(reference, moving, dx, dy);
  return best;
}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/models/point_spread_fit.hpp"

#include <algorithm>
#include <vector>

#include "glint/kernels/core/point_spread.hpp"
#include "glint/kernels/find_points/find_points.hpp"

namespace glint {
namespace {

/// Energy that a Gaussian of this width explains at a point: A^2 / B, P-PHD (13) maximised over I.
double explained(FrameView z, const Point& at, const PointSpread& spread) {
  const int cx = static_cast<int>(at.x + 0.5f), cy = static_cast<int>(at.y + 0.5f);
  double correlation = 0, energy = 0;
  for (int j = -kMaxHalfWidth; j <= kMaxHalfWidth; ++j) {
    for (int i = -kMaxHalfWidth; i <= kMaxHalfWidth; ++i) {
      if (!z.contains(cx + i, cy + j)) continue;
      const double h = spread.weight(i, at.x - cx) * spread.weight(j, at.y - cy);
      correlation += h * z(cx + i, cy + j);
      energy += h * h;
    }
  }
  return correlation > 0 ? correlation * correlation / energy : 0;
}

}  // namespace

double fit_point_spread(FrameView z) {
  constexpr std::size_t kPoints = 20;
  constexpr double kDefault = 1.0, kFirst = 0.4, kLast = 2.4, kStep = 0.05;
  std::vector<Point> points;
  FindPoints::serial({.map = z, .threshold = 5, .radius = 3, .points = &points});
  if (points.empty()) return kDefault;
  std::stable_sort(points.begin(), points.end(),
                   [](const Point& a, const Point& b) { return a.amplitude > b.amplitude; });
  points.resize(std::min(points.size(), kPoints));
  double best = kDefault, most = 0;
  for (double sigma = kFirst; sigma <= kLast; sigma += kStep) {
    double sum = 0;
    for (const auto& p : points) sum += explained(z, p, PointSpread::of(sigma));
    if (sum > most) most = sum, best = sigma;
  }
  return best;
}

}  // namespace glint

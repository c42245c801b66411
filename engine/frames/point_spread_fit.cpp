// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/frames/point_spread_fit.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "glint/kernels/core/point_spread.hpp"
#include "glint/kernels/find_points/find_points.hpp"

namespace glint {
namespace {

constexpr int kHalf = kMaxHalfWidth;

/// Mean of the finite pixels on the edge of the patch around (cx, cy).
double level_around(FrameView image, int cx, int cy) {
  double sum = 0;
  int count = 0;
  for (int j = -kHalf; j <= kHalf; ++j) {
    for (int i = -kHalf; i <= kHalf; ++i) {
      const bool edge = std::max(std::abs(i), std::abs(j)) == kHalf;
      if (!edge || !image.contains(cx + i, cy + j)) continue;
      const float value = image(cx + i, cy + j);
      if (std::isfinite(value)) sum += value, ++count;
    }
  }
  return count > 0 ? sum / count : 0;
}

/// Energy that a Gaussian of this width explains at a point: A^2 / B, P-PHD (13) maximised over I.
double explained(FrameView image, const Point& at, const PointSpread& spread) {
  const int cx = static_cast<int>(std::lround(at.x)), cy = static_cast<int>(std::lround(at.y));
  const double level = level_around(image, cx, cy);
  double correlation = 0, energy = 0;
  for (int j = -kHalf; j <= kHalf; ++j) {
    for (int i = -kHalf; i <= kHalf; ++i) {
      if (!image.contains(cx + i, cy + j) || !std::isfinite(image(cx + i, cy + j))) continue;
      const double h = spread.weight(i, at.x - cx) * spread.weight(j, at.y - cy);
      correlation += h * (image(cx + i, cy + j) - level);
      energy += h * h;
    }
  }
  return energy > 0 ? correlation * correlation / energy : 0;
}

}  // namespace

std::optional<double> fit_point_spread(FrameView whitened, FrameView raw) {
  constexpr std::size_t kPoints = 20;
  constexpr int kFirst = 8, kLast = 48;  // steps of .05 px
  std::vector<Point> points;
  FindPoints::serial({.map = whitened, .threshold = 6, .radius = 3, .points = &points});
  if (points.empty()) return std::nullopt;
  std::stable_sort(points.begin(), points.end(),
                   [](const Point& a, const Point& b) { return a.amplitude > b.amplitude; });
  points.resize(std::min(points.size(), kPoints));
  const FrameView image = raw.empty() ? whitened : raw;
  double best = 0, most = -1;
  for (int step = kFirst; step <= kLast; ++step) {
    const double sigma = 0.05 * step;
    double sum = 0;
    for (const auto& p : points) sum += explained(image, p, PointSpread::of(sigma));
    if (sum > most) most = sum, best = sigma;
  }
  return best;
}

}  // namespace glint

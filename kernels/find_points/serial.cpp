// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "glint/kernels/find_points/find_points.hpp"

namespace glint {
namespace {

bool is_maximum(FrameView map, int x, int y, int radius) {
  const float value = map(x, y);
  for (int v = std::max(0, y - radius); v <= std::min(map.height - 1, y + radius); ++v) {
    for (int u = std::max(0, x - radius); u <= std::min(map.width - 1, x + radius); ++u) {
      const bool earlier = v < y || (v == y && u < x);
      if (map(u, v) > value || (earlier && map(u, v) == value)) return false;
    }
  }
  return true;
}

/// Vertex of the parabola through three pixels one apart, seen from the middle one [px].
double vertex(double before, double middle, double after) {
  const double fall_before = middle - before, fall_after = middle - after;
  const double curvature = fall_before + fall_after;
  if (!(std::isfinite(curvature) && curvature > 0)) return 0;
  return std::clamp(0.5 * (fall_before - fall_after) / curvature, -0.5, 0.5);
}

Point refined(FrameView map, int x, int y) {
  constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
  const auto pixel = [&](int u, int v) { return map.contains(u, v) ? map(u, v) : kMissing; };
  const double value = map(x, y);
  return {static_cast<float>(x + vertex(pixel(x - 1, y), value, pixel(x + 1, y))),
          static_cast<float>(y + vertex(pixel(x, y - 1), value, pixel(x, y + 1))), map(x, y)};
}

void local_maxima(const FindPoints::Args& args) {
  for (int y = 0; y < args.map.height; ++y) {
    for (int x = 0; x < args.map.width; ++x) {
      if (!(args.map(x, y) > args.threshold) || !is_maximum(args.map, x, y, args.radius)) continue;
      args.points->push_back(refined(args.map, x, y));
    }
  }
}

struct BlockMoments {
  double sum = 0, minimum = std::numeric_limits<double>::infinity();
  int count = 0;
};

/// The sum is by columns first: the order that the fast path decides in.
BlockMoments moments(FrameView map, const Box& block) {
  BlockMoments m;
  for (int x = block.x0; x < block.x1; ++x) {
    double column = 0;
    for (int y = block.y0; y < block.y1; ++y) {
      const double value = map(x, y);
      if (!std::isfinite(value)) continue;
      column += value;
      m.minimum = std::min(m.minimum, value);
      ++m.count;
    }
    m.sum += column;
  }
  return m;
}

Point centroid(FrameView map, const Box& block, const BlockMoments& m) {
  double mass = 0, x_mass = 0, y_mass = 0;
  double x_pixels = 0, y_pixels = 0;
  for (int y = block.y0; y < block.y1; ++y) {
    for (int x = block.x0; x < block.x1; ++x) {
      if (!std::isfinite(map(x, y))) continue;
      const double w = map(x, y) - m.minimum;
      mass += w, x_mass += w * x, y_mass += w * y;
      x_pixels += x, y_pixels += y;
    }
  }
  const auto mean = static_cast<float>(m.sum / m.count);
  if (mass > 0) {
    return {static_cast<float>(x_mass / mass), static_cast<float>(y_mass / mass), mean};
  }
  return {static_cast<float>(x_pixels / m.count), static_cast<float>(y_pixels / m.count), mean};
}

void units(const FindPoints::Args& args) {
  const FrameView map = args.map;
  for (int y = 0; y < map.height; y += 5) {
    for (int x = 0; x < map.width; x += 5) {
      const Box block{x, y, std::min(x + 5, map.width), std::min(y + 5, map.height)};
      const BlockMoments m = moments(map, block);
      // P-HPMHT (20), times the number of pixels: exact in double.
      if (m.count == 0 || !(m.sum > static_cast<double>(args.threshold) * m.count)) continue;
      args.points->push_back(centroid(map, block, m));
    }
  }
}

}  // namespace

void FindPoints::serial(const Args& args) {
  args.points->clear();
  args.mode == Mode::local_maximum ? local_maxima(args) : units(args);
}

}  // namespace glint

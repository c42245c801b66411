// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "glint/kernels/particle_likelihood/check.hpp"
#include "glint/kernels/particle_likelihood/particle_likelihood.hpp"
#include "glint/kernels/particle_likelihood/position.hpp"

namespace glint {
namespace {

using particle_likelihood::from_edge;
using particle_likelihood::inside;
using particle_likelihood::jittered;

/// Window of a particle along one axis.
struct Axis {
  int pixel;                                            ///< that holds the particle
  std::array<double, 2 * kMaxHalfWidth + 1> weights{};  ///< 0 outside the frame
  double energy = 0;                                    ///< sum of the squared weights
};

Axis axis(float x, int size, const PointSpread& spread) {
  Axis out{static_cast<int>(from_edge(x))};
  const double offset = static_cast<double>(x) - out.pixel;
  const double scale = 1 / (spread.sigma * std::numbers::sqrt2);
  const int half = spread.half_width;
  double below = std::erf((-half - 0.5 - offset) * scale);
  for (int k = -half; k <= half; ++k) {
    const double above = std::erf((k + 0.5 - offset) * scale);
    const double weight = (above - below) / 2;  // P-PHD (4), one axis
    below = above;
    if (out.pixel + k < 0 || out.pixel + k >= size) continue;
    out.weights.data()[half + k] = weight;
    out.energy += weight * weight;
  }
  return out;
}

/// P-PHD (13) over the window of (18): I A - I^2 B / 2, A = sum of w z, B = sum of w^2.
double log_ratio(const FrameView& frame, const PointSpread& spread, float x, float y,
                 double intensity) {
  const Axis column = axis(x, frame.width, spread), row = axis(y, frame.height, spread);
  const int half = spread.half_width;
  double matched = 0;
  for (int l = -half; l <= half; ++l) {
    const double row_weight = row.weights.data()[half + l];
    if (row_weight == 0) continue;
    for (int k = -half; k <= half; ++k) {
      const double weight = row_weight * column.weights.data()[half + k];
      if (weight != 0) matched += weight * frame(column.pixel + k, row.pixel + l);
    }
  }
  return intensity * matched - intensity * intensity * column.energy * row.energy / 2;
}

}  // namespace

void ParticleLikelihood::serial(const Args& args) {
  particle_likelihood::check(args);
  for (std::size_t i = 0; i < args.x.size(); ++i) {
    float x = args.x[i], y = args.y[i];
    if (args.jitter > 0) {
      const Normals4 normals = random_normals(args.key, static_cast<std::uint32_t>(i));
      x = jittered(x, args.jitter, normals.n[0]);
      y = jittered(y, args.jitter, normals.n[1]);
    }
    const bool seen = inside(from_edge(x), args.frame.width) &&
                      inside(from_edge(y), args.frame.height) && std::isfinite(args.intensity[i]);
    args.log_ratio[i] =
        seen ? static_cast<float>(log_ratio(args.frame, args.spread, x, y, args.intensity[i]))
             : -std::numeric_limits<float>::infinity();
  }
}

}  // namespace glint

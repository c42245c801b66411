// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/h_pmht/point_evidence.hpp"

#include <algorithm>
#include <cmath>

#include "glint/kernels/cell_weights/bound.hpp"

namespace glint {
namespace {

constexpr int kFarthest = 8;  // [px] from the expected place

/// Correlation with the point spread around a pixel, over the part inside the frame, and the sum of
/// the squared weights there.
struct Correlation {
  double with_target = 0, energy = 0;
};
Correlation correlate(FrameView z, const PointSpread& spread, int x, int y) {
  const auto weights = spread.centred_weights();
  const int h = spread.half_width;
  const double* const centred = weights.data() + h;
  Correlation sum;
  for (int j = std::max(-h, -y); j <= std::min(h, z.height - 1 - y); ++j) {
    const float* row = z.row(y + j);
    for (int i = std::max(-h, -x); i <= std::min(h, z.width - 1 - x); ++i) {
      const double w = centred[i] * centred[j];
      sum.with_target += w * row[x + i], sum.energy += w * w;
    }
  }
  return sum;
}

double ratio_at(FrameView z, const PointSpread& spread, std::span<const double> intensities, int x,
                int y) {
  const Correlation c = correlate(z, spread, x, y);
  double sum = 0;
  for (const double a : intensities) {
    const double log_ratio = a * c.with_target - a * a * c.energy / 2;
    sum += std::exp(double{bounded_log_ratio(static_cast<float>(log_ratio))});
  }
  return sum / static_cast<double>(intensities.size());
}

}  // namespace

double mean_likelihood_ratio(FrameView z, const PointSpread& spread,
                             std::span<const double> intensities, const ExpectedPlace& place) {
  constexpr double kPixel = 1.0 / 12;  // variance of a place within its pixel [px^2]
  constexpr double kSigmas = 3;
  const double var_x = place.var_x + kPixel, var_y = place.var_y + kPixel;
  const auto reach = [](double variance) {
    return std::min(kFarthest, static_cast<int>(std::ceil(kSigmas * std::sqrt(variance))));
  };
  const int x0 = static_cast<int>(std::floor(place.x + 0.5));
  const int y0 = static_cast<int>(std::floor(place.y + 0.5));
  double sum = 0, weights = 0;
  for (int y = y0 - reach(var_y); y <= y0 + reach(var_y); ++y) {
    for (int x = x0 - reach(var_x); x <= x0 + reach(var_x); ++x) {
      const double off_x = x - place.x, off_y = y - place.y;
      const double w = std::exp(-off_x * off_x / (2 * var_x) - off_y * off_y / (2 * var_y));
      weights += w;
      if (z.contains(x, y)) sum += w * ratio_at(z, spread, intensities, x, y);
    }
  }
  return weights > 0 ? sum / weights : 0;
}

}  // namespace glint

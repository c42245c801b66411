// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/core/point_spread.hpp"

#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>

namespace glint {

PointSpread PointSpread::of(double sigma) {
  const double half = std::floor(3 * sigma + 1e-9);
  if (!(sigma > 0) || half > kMaxHalfWidth) {
    throw std::invalid_argument("point spread sigma must be in (0, 2.66] px, got " +
                                std::to_string(sigma));
  }
  return {sigma, static_cast<int>(half)};
}

double PointSpread::weight(int k, double offset) const {
  const double scale = 1 / (sigma * std::numbers::sqrt2);
  return 0.5 * (std::erf((k + 0.5 - offset) * scale) - std::erf((k - 0.5 - offset) * scale));
}

std::array<double, 2 * kMaxHalfWidth + 1> PointSpread::centred_weights() const {
  std::array<double, 2 * kMaxHalfWidth + 1> w{};
  int k = -half_width;
  for (double& share : std::span(w).first(static_cast<std::size_t>(width())))
    share = weight(k++, 0);
  return w;
}

double PointSpread::intensity_of_snr(double snr) const {
  return 2 * std::numbers::pi * sigma * sigma * std::pow(10.0, snr / 20);  // P-PHD (5)
}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>

namespace glint {

/// Widest window that kernels take: 2 * 7 + 1 = 15 pixels.
inline constexpr int kMaxHalfWidth = 7;

/// Gaussian point spread integrated over square pixels, seen through a window. P-PHD (4), (18).
struct PointSpread {
  double sigma = 1.0;  ///< [px]
  int half_width = 3;  ///< window of 2 half_width + 1 pixels

  /// Window of +-3 sigma, floor(3 sigma) pixels each way. Throws std::invalid_argument unless
  /// 0 < sigma < 2.67 px (the window must fit kMaxHalfWidth).
  static PointSpread of(double sigma);
  int width() const { return 2 * half_width + 1; }

  /// Share of a target's intensity, along one axis, in the pixel `k` away from the one that holds
  /// it, when the target lies `offset` [px], |offset| <= .5, from that pixel's centre.
  double weight(int k, double offset) const;
  /// The weights of the window's pixels for a target at a pixel centre; entries beyond it are 0.
  std::array<double, 2 * kMaxHalfWidth + 1> centred_weights() const;

  /// Intensity whose continuous peak is `snr` [dB] above unit noise: 2 pi sigma^2 10^(snr/20).
  /// P-PHD (5).
  double intensity_of_snr(double snr) const;
  bool operator==(const PointSpread&) const = default;
};

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "glint/kernels/core/device.hpp"
#include "glint/kernels/core/frame.hpp"

namespace glint {

/// Spots of a single frame, from one pixel to several wide: the undecimated (a trous) B3-spline
/// wavelet transform (Starck, Murtagh and Bijaoui, Image Processing and Data Analysis, 1998), of
/// which the significant coefficients are summed, each in its scale's own noise. P-PMHT says of its
/// points that they come from wavelets, its [39], and no more.
///
/// With c_0 the frame, c_j is c_{j-1} smoothed along each axis by [1 4 6 4 1] / 16 with taps
/// 2^(j-1) px apart, mirrored at the border, and w_j = c_{j-1} - c_j is what scale j sees. A
/// coefficient counts where it exceeds k times its scale's noise.
class WaveletFilter {
 public:
  static constexpr std::size_t kScales = 3;
  /// Standard deviation of w_j, and of the sum of all w_j over theirs, in white noise of unit
  /// deviation far from the border.
  static constexpr std::array<double, kScales> kUnitNoise{0.89079631, 0.20066385, 0.08550750};
  static constexpr double kUnitSum = 2.19316585;

  explicit WaveletFilter(const Device& device) : device_(device) {}
  /// The sum over scales of w_j / sigma_j where that exceeds `k`, over kUnitSum: unit noise gives
  /// unit noise, but for what `k` takes away; 0 where no scale sees anything. sigma_j is 1.4826
  /// times the median deviation of w_j from its median over known pixels (at most 16384, on a
  /// grid), and at least what unit noise has: over half of a compressed clip may stand still, and
  /// then the median says nothing of the noise. Pixels of exactly 0, masked or frozen, are not
  /// known: they are NaN in the response. Valid until the next call.
  FrameView response(FrameView whitened, double k);

 private:
  void fit(FrameView frame);
  FrameView level(FrameView whitened, std::size_t scale) const;
  void smooth(FrameView from, std::size_t scale);
  void measure_noise(FrameView whitened);
  void add_up(FrameView whitened, float k);

  Device device_;
  std::array<Image<float>, kScales> smooth_;  ///< c_1 to c_3
  Image<float> response_;
  std::vector<std::vector<float>> lines_;            ///< of each tile, a row and what is beyond it
  std::array<std::vector<float>, kScales> samples_;  ///< of each scale's coefficients
  std::array<float, kScales> sigma_{};
};

}  // namespace glint

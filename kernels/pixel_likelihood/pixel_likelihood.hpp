// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <string_view>
#include <variant>
#include <vector>

#include "glint/kernels/core/frame.hpp"
#include "glint/kernels/core/point_spread.hpp"
#include "glint/kernels/core/trial.hpp"

namespace glint {

/// A pixel whose log-likelihood ratio exceeds the threshold.
struct Hit {
  std::int32_t x, y;
  float value;
  bool operator==(const Hit&) const = default;
};

/// Log-likelihood ratio of "a target of this intensity sits at this pixel's centre" against noise,
/// for every pixel of a frame: sum over the window of h z - h^2 / 2 with h the pixel-integrated
/// point spread. P-PHD (13) with (4); quadratic in intensity, so one correlation serves: I A - I^2
/// B / 2. Windows are clipped at the border and not renormalised.
struct PixelLikelihood {
  static constexpr std::string_view name = "pixel_likelihood";
  /// Of the map, for |z| <= 8: float sums over at most 15 x 15 pixels.
  static constexpr Tolerance tolerance{1e-5, 1e-6};

  struct Args {
    std::variant<ImageView<const float>, ImageView<const std::uint16_t>> frame;
    float offset = 0, scale = 1;  ///< z = (pixel - offset) * scale has unit noise
    PointSpread spread = {};
    float intensity = 1;               ///< [noise sigmas], whole target
    float threshold = 0;               ///< a hit is map > threshold
    ImageView<float> map = {};         ///< written if not empty; size of the frame
    std::vector<Hit>* hits = nullptr;  ///< replaced if given; row by row, left to right
  };
  static void serial(const Args& args);
  static void tbb(const Args& args, Workers& workers);
  static void egl(const Args& args, gl::Context& context);
  static std::vector<std::unique_ptr<Trial>> trials();
};

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "glint/kernels/core/frame.hpp"
#include "glint/kernels/core/random.hpp"

namespace glint {

inline constexpr float kInfinity = std::numeric_limits<float>::infinity();
inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// A frame of standard normal noise, the same on every call.
inline Image<float> noise_frame(int width, int height) {
  Image<float> image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto item = static_cast<std::uint32_t>(y * width + x);
      image.view()(x, y) = random_normals(random_key(5, 0, Purpose::trial), item).n[0];
    }
  }
  return image;
}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>
#include <functional>
#include <vector>

#include "glint/engine/frames/frame_preparer.hpp"
#include "glint/kernels/core/random.hpp"

namespace glint::test {

constexpr int kWidth = 96, kHeight = 80;

/// A scene with an edge, white noise and a bright Gaussian target that moves 1.5 px a frame.
struct Scene {
  int width = kWidth, height = kHeight;
  float noise = 2, amplitude = 20;
  double pan = 0;  ///< movement of everything but the target [px/frame]

  double target_x(int frame) const { return 12 + 1.5 * frame; }
  std::vector<float> at(int frame) const {
    std::vector<float> pixels;
    const RandomKey key = random_key(7, static_cast<std::uint64_t>(frame), Purpose::trial);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const auto item = static_cast<std::uint32_t>(y * width + x);
        const double u = x + pan * frame;
        const double ground = 15 * std::sin(0.5 * u) * std::cos(0.4 * y) + (y > 60 ? 40 : 0);
        const double dx = x - target_x(frame), dy = y - 30;
        const double target = amplitude * std::exp(-(dx * dx + dy * dy) / 2);
        pixels.push_back(static_cast<float>(100 + ground + target) +
                         noise * random_normals(key, item).n[0]);
      }
    }
    return pixels;
  }
};

inline RawPixels raw(const std::vector<float>& pixels, int width = kWidth, int height = kHeight) {
  return {pixels.data(), width, height, 1, width};
}

/// Prepares frames 0 .. n - 1 and returns the last Scan.
inline Scan prepare(
    FramePreparer& preparer, const Scene& scene, int n,
    const std::function<void(std::vector<float>&)>& change = [](auto&) {}) {
  Scan scan;
  for (int t = 0; t < n; ++t) {
    std::vector<float> pixels = scene.at(t);
    change(pixels);
    scan = preparer.prepare(raw(pixels, scene.width, scene.height), t, t / 30.0);
  }
  return scan;
}

inline bool all_finite(FrameView image) {
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (!std::isfinite(image(x, y))) return false;
    }
  }
  return true;
}

inline double deviation(FrameView z) {
  double sum = 0;
  for (int y = 0; y < z.height; ++y) {
    for (int x = 0; x < z.width; ++x) sum += static_cast<double>(z(x, y)) * z(x, y);
  }
  return std::sqrt(sum / (z.width * z.height));
}

}  // namespace glint::test

// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "glint/kernels/prepare_frame/whiten.hpp"

namespace glint {
namespace {

Box window(int x, int y, int half, int width, int height) {
  return {std::max(0, x - half), std::max(0, y - half), std::min(width, x + half + 1),
          std::min(height, y + half + 1)};
}

/// Maximum minus minimum of 3x3, 0 if all are NaN.
double gradient(FrameView image, int x, int y) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  const Box box = window(x, y, 1, image.width, image.height);
  for (int v = box.y0; v < box.y1; ++v) {
    for (int u = box.x0; u < box.x1; ++u) {
      const double value = image(u, v);
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  return high >= low ? high - low : 0;
}

/// Root mean square of the clipped residual over the ring's pixels that have one.
double ring_rms(const Whiten::Args& args, int x, int y) {
  const int width = args.image.width, height = args.image.height;
  const Box outer = window(x, y, args.ring_outer, width, height);
  const Box inner = window(x, y, args.ring_inner, width, height);
  const double most = args.ring_clip * args.sigma * args.ring_clip * args.sigma;
  double sum = 0;
  int count = 0;
  for (int v = outer.y0; v < outer.y1; ++v) {
    for (int u = outer.x0; u < outer.x1; ++u) {
      const double r = static_cast<double>(args.image(u, v)) - args.background(u, v);
      if (inner.contains(u, v) || std::isnan(r)) continue;
      sum += std::min(r * r, most);
      ++count;
    }
  }
  return count == 0 ? 0 : std::sqrt(sum / count);
}

double signed_by(Polarity polarity, double z) {
  if (polarity == Polarity::bright) return z;
  if (polarity == Polarity::dark) return -z;
  return std::abs(z) - std::sqrt(2 / std::numbers::pi);
}

double median_of(std::vector<double>& values) {
  const std::size_t n = values.size();
  std::sort(values.begin(), values.end());
  return n == 0 ? 0 : (values[(n - 1) / 2] + values[n / 2]) / 2;
}

}  // namespace

void BackgroundStructure::serial(const Args& args) {
  const int width = args.background.width, height = args.background.height;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      double most = 0;
      const Box box = window(x, y, 2, width, height);
      for (int v = box.y0; v < box.y1; ++v) {
        for (int u = box.x0; u < box.x1; ++u) {
          most = std::max(most, gradient(args.background, u, v));
        }
      }
      args.structure(x, y) = static_cast<float>(args.share * most);
    }
  }
}

int RobustSpread::step(int width, int height) {
  for (int step = 1;; step += 2) {
    const auto columns = (width + step - 1) / step, rows = (height + step - 1) / step;
    if (static_cast<double>(columns) * rows <= kSamples) return step;
  }
}

void RobustSpread::serial(const Args& args) {
  const int grid = step(args.image.width, args.image.height);
  std::vector<double> residuals;
  for (int y = 0; y < args.image.height; y += grid) {
    for (int x = 0; x < args.image.width; x += grid) {
      const double background = args.background.empty() ? 0 : args.background(x, y);
      const double r = args.image(x, y) - background;
      if (!std::isnan(r)) residuals.push_back(r);
    }
  }
  args.spread->median = median_of(residuals);
  for (double& r : residuals) r = std::abs(r - args.spread->median);
  args.spread->sigma = 1.4826 * median_of(residuals);
}

void Whiten::serial(const Args& args) {
  for (int y = 0; y < args.image.height; ++y) {
    for (int x = 0; x < args.image.width; ++x) {
      const double r = static_cast<double>(args.image(x, y)) - args.background(x, y);
      double noise = args.sigma;
      if (args.ring_outer > 0) noise = std::max(noise, ring_rms(args, x, y));
      if (!args.structure.empty()) noise = std::max<double>(noise, args.structure(x, y));
      const double z =
          std::clamp(signed_by(args.polarity, r / noise), args.clip_low, args.clip_high);
      args.whitened(x, y) = std::isnan(r) ? 0.0F : static_cast<float>(z);
      if (args.noise.empty() || x % args.noise_step != 0 || y % args.noise_step != 0) continue;
      args.noise(x / args.noise_step, y / args.noise_step) =
          std::isnan(r) ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(noise);
    }
  }
}

}  // namespace glint

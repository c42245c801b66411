// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "glint/kernels/pixel_likelihood/check.hpp"
#include "glint/kernels/pixel_likelihood/pixel_likelihood.hpp"

namespace glint {
namespace {

/// Sum over the pixels of the window around (x, y) that the frame has. P-PHD (13).
template <class T>
double log_ratio(const PixelLikelihood::Args& args, const ImageView<const T>& frame,
                 const std::array<double, 2 * kMaxHalfWidth + 1>& weights, int x, int y) {
  const int half = args.spread.half_width;
  const double* const tap = weights.data() + half;  // tap[-half] to tap[half]
  double sum = 0;
  for (int l = -half; l <= half; ++l) {
    for (int k = -half; k <= half; ++k) {
      if (!frame.contains(x + k, y + l)) continue;
      const double h = static_cast<double>(args.intensity) * tap[k] * tap[l];  // P-PHD (4)
      const double z = (static_cast<double>(frame(x + k, y + l)) - args.offset) * args.scale;
      sum += h * z - h * h / 2;
    }
  }
  return sum;
}

template <class T>
void scan(const PixelLikelihood::Args& args, const ImageView<const T>& frame) {
  const auto weights = args.spread.centred_weights();
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      const auto value = static_cast<float>(log_ratio(args, frame, weights, x, y));
      if (!args.map.empty()) args.map(x, y) = value;
      if (args.hits != nullptr && value > args.threshold) args.hits->push_back({x, y, value});
    }
  }
}

}  // namespace

void PixelLikelihood::serial(const Args& args) {
  pixel_likelihood::check(args);
  if (args.hits != nullptr) args.hits->clear();
  std::visit([&](const auto& frame) { scan(args, frame); }, args.frame);
}

}  // namespace glint

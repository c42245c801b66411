// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "glint/kernels/prepare_frame/prepare_frame.hpp"

namespace glint {
namespace {

template <class T>
double grey_of(const T* pixel, int channels) {
  if (channels == 1) return static_cast<double>(pixel[0]);
  return .2989 * pixel[2] + .587 * pixel[1] + .114 * pixel[0];  // P-HPMHT (1)
}

}  // namespace

void ToGrey::serial(const Args& args) {
  bool masked = false;
  const auto convert = [&](auto* data) {
    for (int y = 0; y < args.raw.height; ++y) {
      for (int x = 0; x < args.raw.width; ++x) {
        double grey = grey_of(data + y * args.raw.pitch + x * args.raw.channels, args.raw.channels);
        if (!(std::abs(grey) <= kLargest)) {
          grey = std::numeric_limits<double>::quiet_NaN();
          masked = true;
        } else if (args.reciprocal) {
          grey = 255 / std::max(grey, static_cast<double>(args.reciprocal_floor));  // P-HPMHT (2)
        }
        args.grey(x, y) = static_cast<float>(grey);
      }
    }
  };
  std::visit(convert, args.raw.data);
  if (args.masked != nullptr) *args.masked = masked;
}

}  // namespace glint

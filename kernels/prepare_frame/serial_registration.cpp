// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "glint/kernels/prepare_frame/registration.hpp"
#include "glint/kernels/prepare_frame/search.hpp"

namespace glint {
namespace {

/// Bilinear value at (x + dx, y + dy); NaN beyond the outermost pixel centres.
double sample(FrameView image, int x, int y, double dx, double dy) {
  const double u = x + dx, v = y + dy;
  if (!(u >= 0 && v >= 0 && u <= image.width - 1 && v <= image.height - 1)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const int i = std::min(static_cast<int>(u), std::max(0, image.width - 2));
  const int j = std::min(static_cast<int>(v), std::max(0, image.height - 2));
  const double a = u - i, b = v - j;
  const int i1 = a > 0 ? i + 1 : i, j1 = b > 0 ? j + 1 : j;
  const double top = (1 - a) * image(i, j) + a * image(i1, j);
  const double bottom = (1 - a) * image(i, j1) + a * image(i1, j1);
  return (1 - b) * top + b * bottom;
}

double mean_difference(FrameView reference, FrameView moving, double dx, double dy) {
  double sum = 0;
  std::int64_t count = 0;
  const int step = row_step(reference.width, reference.height);
  for (int y = 0; y < reference.height; y += step) {
    for (int x = 0; x < reference.width; ++x) {
      const double difference = std::abs(sample(moving, x, y, dx, dy) - reference(x, y));
      if (std::isnan(difference)) continue;
      sum += difference;
      ++count;
    }
  }
  return count == 0 ? 0 : sum / static_cast<double>(count);
}

NormalEquations normal_equations(FrameView reference, FrameView moving, double dx, double dy) {
  NormalEquations sums;
  const int step = row_step(reference.width, reference.height);
  for (int y = 1; y < reference.height - 1; y += step) {
    for (int x = 1; x < reference.width - 1; ++x) {
      const double gx = (static_cast<double>(reference(x + 1, y)) - reference(x - 1, y)) / 2;
      const double gy = (static_cast<double>(reference(x, y + 1)) - reference(x, y - 1)) / 2;
      const double e = sample(moving, x, y, dx, dy) - reference(x, y);
      if (std::isnan(gx + gy + e)) continue;
      sums.xx += gx * gx, sums.xy += gx * gy, sums.yy += gy * gy;
      sums.xe += gx * e, sums.ye += gy * e;
    }
  }
  return sums;
}

}  // namespace

void Halve::serial(const Args& args) {
  for (int y = 0; y < args.half.height; ++y) {
    for (int x = 0; x < args.half.width; ++x) {
      const double sum = static_cast<double>(args.image(2 * x, 2 * y)) +
                         args.image(2 * x + 1, 2 * y) + args.image(2 * x, 2 * y + 1) +
                         args.image(2 * x + 1, 2 * y + 1);
      args.half(x, y) = static_cast<float>(sum / 4);
    }
  }
}

void EstimateShift::serial(const Args& args) {
  *args.shift = search_shift(args, mean_difference, normal_equations);
}

void ShiftImage::serial(const Args& args) {
  for (int y = 0; y < args.image.height; ++y) {
    for (int x = 0; x < args.image.width; ++x) {
      args.moved(x, y) = static_cast<float>(sample(args.image, x, y, args.dx, args.dy));
    }
  }
}

}  // namespace glint

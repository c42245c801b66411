// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "glint/kernels/prepare_frame/background.hpp"

namespace glint {
namespace {

/// Mean of the two middle values; NaN of nothing. Reorders the values.
double median_of(std::vector<double>& values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return (values[(n - 1) / 2] + values[n / 2]) / 2;
}

}  // namespace

void StackMedian::serial(const Args& args) {
  std::vector<double> samples;
  const auto run = [&](const auto& images) {
    for (int y = 0; y < args.median.height; ++y) {
      for (int x = 0; x < args.median.width; ++x) {
        samples.clear();
        for (const auto& image : images) {
          const auto value = static_cast<double>(image(x, y));
          if (!std::isnan(value)) samples.push_back(value);
        }
        args.median(x, y) = static_cast<float>(median_of(samples));
      }
    }
  };
  std::visit(run, args.stack);
}

void SpatialMedian::serial(const Args& args) {
  const int width = args.image.width, height = args.image.height;
  std::vector<double> samples;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      samples.clear();
      for (int j = -2; j <= 2; ++j) {
        for (int i = -2; i <= 2; ++i) {
          const double value = args.image(std::clamp(x + i * args.spacing, 0, width - 1),
                                          std::clamp(y + j * args.spacing, 0, height - 1));
          if (!std::isnan(value)) samples.push_back(value);
        }
      }
      args.median(x, y) = static_cast<float>(median_of(samples));
    }
  }
}

}  // namespace glint

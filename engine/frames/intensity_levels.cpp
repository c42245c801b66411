// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/frames/intensity_levels.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace glint {
namespace {

/// The value at `share` of the sorted values.
double quantile(std::vector<float>& values, double share) {
  const auto rank = static_cast<std::size_t>(share * static_cast<double>(values.size()));
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::min(rank, values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return static_cast<double>(*at);
}

}  // namespace

IntensityLevels intensity_levels(FrameView frame, std::vector<float>& workspace) {
  workspace.clear();
  double sum = 0;
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      const float value = frame(x, y);
      if (std::isfinite(value)) workspace.push_back(value), sum += static_cast<double>(value);
    }
  }
  if (workspace.empty()) return {};
  return {sum / static_cast<double>(workspace.size()), quantile(workspace, 0.999)};
}

RobustMoments robust_moments(std::vector<float>& values) {
  if (values.empty()) return {};
  const double median = quantile(values, 0.5);
  for (float& v : values) v = static_cast<float>(std::abs(static_cast<double>(v) - median));
  return {median, 1.4826 * quantile(values, 0.5)};
}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <limits>

namespace glint {

/// A point of a scan: where a detector saw something, and how bright.
struct PointMeasurement {
  double x = 0, y = 0;  ///< [px], or the unit of length that the points and the settings share
  double amplitude = std::numeric_limits<double>::quiet_NaN();  ///< [sigma]; NaN: not known
  bool operator==(const PointMeasurement&) const = default;
};

}  // namespace glint

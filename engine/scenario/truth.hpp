// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <limits>

namespace glint {

/// Where a real target is at a frame. Unknown values are NaN.
struct TruthPoint {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  std::int64_t frame = 0, track_id = 0;
  double x = kUnknown, y = kUnknown;    ///< [px]
  double vx = kUnknown, vy = kUnknown;  ///< [px/s]
  double intensity = kUnknown;          ///< total, in the units of the frame's pixels
  bool operator==(const TruthPoint&) const = default;
};

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "glint/kernels/find_points/find_points.hpp"

namespace glint {

/// A target that two successive frames hint at.
struct PairStart {
  double x = 0, y = 0;                ///< in the later frame [px]
  double before_x = 0, before_y = 0;  ///< in the earlier one [px]
  double score = 0;                   ///< sum of the two amplitudes
};

/// Pairs points of two successive frames that one target could have caused.
class PairStarts {
 public:
  /// All pairs at most `reach` [px] apart, by falling score; each point comes in many. Points are
  /// row by row. Valid until the next call.
  std::span<const PairStart> find(std::span<const Point> before, std::span<const Point> now,
                                  double reach);

 private:
  std::vector<PairStart> pairs_;
};

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>

#include "glint/kernels/core/isa.hpp"

namespace glint {

struct FindPointsLanes {
  /// Writes the first columns of the groups of pixels that may hold one above the threshold to
  /// `groups` (room for `width`) and returns how many.
  int (*groups_above)(const float* row, int width, float threshold, std::int32_t* groups);
  /// Writes the columns of the groups of row `y` that are local maxima above the threshold to
  /// `found` (room for `width`) and returns how many.
  int (*maxima)(const float* map, std::ptrdiff_t pitch, int width, int height, int y,
                float threshold, int radius, const std::int32_t* groups, int group_count,
                std::int32_t* found);
  /// Writes the indices of the 5x5 blocks, `rows` <= 5 high from `band` down, whose mean exceeds
  /// the threshold to `found` (room for `width`) and returns how many.
  int (*units)(const float* band, std::ptrdiff_t pitch, int width, int rows, float threshold,
               std::int32_t* found);
};
GLINT_DECLARE_LANES(FindPointsLanes, find_points_lanes)

}  // namespace glint

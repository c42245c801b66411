// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "glint/kernels/core/inline.hpp"
#include "glint/kernels/core/isa.hpp"
#include "glint/kernels/dp_stage/dp_stage.hpp"

namespace glint {

/// Largest reach that `near_row` takes: its moves along an axis fit half a word of bits [px].
inline constexpr int kNearReach = 7;
/// Cells that the rows for `near_row` have on either side, beyond the row and a vector.
inline constexpr int kNearPad = 16;

/// A move in one number, dx as its lowest byte.
GLINT_INLINE constexpr std::int32_t move_code(int dx, int dy) { return dy * 256 + (dx & 255); }

struct NearMove {
  std::int32_t bits;  ///< one for dx and one for dy, as in MoveRefusals
  std::int32_t code;  ///< move_code()
};

/// Predecessors of a row of cells: row i is that of the moves with dy = i - reach. Cells outside
/// the frame have the value -infinity.
struct NearRows {
  const float* values[2 * kNearReach + 1];
  const std::int32_t* refused[2 * kNearReach + 1];  ///< of DpStageLanes::refuse
  const NearMove* moves;                            ///< by dy, then by dx
};

/// By a move along an axis as a byte, bits of the moves that may not follow it, bit d + reach for
/// d; those along y 16 bits higher.
struct MoveRefusals {
  std::int32_t x[256], y[256];
};

struct DpStageLanes {
  /// Rows [y0, y1) of the stage, for any reach.
  void (*rows)(const DpStage::Args& args, int y0, int y1);
  /// Which moves along x or y may not follow those of `n` cells.
  void (*refuse)(const MoveRefusals& refusals, const std::int8_t* dx, const std::int8_t* dy, int n,
                 std::int32_t* refused);
  /// Cells [x0, x1) of row `y` of the stage; `before` counts columns from x0.
  void (*near_row)(const DpStage::Args& args, const NearRows& before, int y, int x0, int x1);
};
GLINT_DECLARE_LANES(DpStageLanes, dp_stage_lanes)

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "glint/kernels/core/frame.hpp"
#include "glint/kernels/core/trial.hpp"

namespace glint {

/// How a cell's best path came to it in the last step [px]; both at most kMaxDpReach.
struct MovesView {
  ImageView<const std::int8_t> dx, dy;
  bool empty() const { return dx.empty(); }
};

/// Largest move of a dynamic program [px].
inline constexpr int kMaxDpReach = 63;

/// One stage of the dynamic program for track-before-detect, over all cells of a frame:
/// J_k(c) = s_k(c) + max over moves d of J_{k-1}(c - d), |d| <= reach along each axis, and
/// |d - d'| <= tolerance along each axis with d' the move that the best path to c - d ended with
/// (greedy: only that path is remembered). Of equal paths the one of the least dy, then of the
/// least dx is taken. A cell that no path reaches has J = -infinity and the move (0, 0).
/// Predecessors that are NaN are no path.
struct DpStage {
  static constexpr std::string_view name = "dp_stage";
  /// One rounded sum: every device gives the same bits.
  static constexpr Tolerance tolerance{0, 0};

  struct Args {
    FrameView score;                ///< s_k
    FrameView before;               ///< J_{k-1}, size of the score; at the second stage this is s_1
    MovesView moves;                ///< that led to `before`; empty: any move may follow
    int reach = 3;                  ///< [px], 0 to kMaxDpReach
    int tolerance = 2;              ///< [px], >= 0
    ImageView<float> total;         ///< J_k, written; may not share memory with what is read
    ImageView<std::int8_t> dx, dy;  ///< best moves, written
  };
  /// All throw std::invalid_argument for views of different sizes and for a reach or a tolerance
  /// out of range.
  static void serial(const Args& args);
  static void tbb(const Args& args, Workers& workers);
  static void egl(const Args& args, gl::Context& context);
  static std::vector<std::unique_ptr<Trial>> trials();
};

namespace dp_stage {
void check(const DpStage::Args& args);
}

}  // namespace glint

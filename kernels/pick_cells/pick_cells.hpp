// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "glint/kernels/core/frame.hpp"
#include "glint/kernels/core/trial.hpp"

namespace glint {

/// Draws, for each of a list of cells, one within reach of it in proportion to the scores there: a
/// two-frame birth's cell in the second frame. Scores are added row by row, in double.
struct PickCells {
  static constexpr std::string_view name = "pick_cells";
  static constexpr Tolerance tolerance{0, 1e-12};  ///< of the totals; all else is equal

  struct Args {
    FrameView score;                      ///< >= 0
    int reach = 0;                        ///< along each axis, clipped at the border [px]
    std::span<const std::uint32_t> cell;  ///< y * width + x
    std::span<const float> uniform;       ///< in (0, 1), one a cell
    std::span<std::uint32_t> picked;      ///< written: the cell drawn for each
    std::span<float> picked_score;        ///< written: its score
    std::span<double> total;              ///< written: of the scores in reach
  };
  /// All throw std::invalid_argument for spans of unlike lengths, a negative reach and cells beyond
  /// the frame.
  static void serial(const Args& args);
  static void tbb(const Args& args, Workers& workers);
  static void egl(const Args& args, gl::Context& context);
  static std::vector<std::unique_ptr<Trial>> trials();
};

namespace pick_cells {
void check(const PickCells::Args& args);
}

}  // namespace glint

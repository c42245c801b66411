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

/// Particles grouped by the pixel that holds them: run r is the particles order[first[r]] ..
/// order[first[r + 1] - 1] in ascending index, all in pixel cell[r] = y * width + x; cells ascend.
/// Particles outside the frame are in no run.
struct CellRuns {
  std::vector<std::uint32_t> order, cell, first;
  std::vector<float> mass;  ///< posterior weight in the cell, after the update

  std::size_t size() const { return cell.size(); }
};

/// Sum of `mass` over the runs, in their order: the expected number of targets. P-PHD (16).
double total_mass(const CellRuns& runs);

/// sums[r] = sum of `values` (one a run) over the runs whose pixels lie in the window of
/// 2 half_width + 1 pixels around run r's, clipped at the border. Costs as many steps as there are
/// runs in windows, whatever the frame's size. Added in ascending order of pixels, in double.
void box_sums(const CellRuns& runs, int width, int height, int half_width,
              std::span<const float> values, std::span<float> sums);

/// Memory that cell_weights keeps from call to call, so that a warm call allocates nothing.
struct CellWorkspace {
  CellRuns runs;
  std::vector<float> cell_sum, box_sum;  ///< per run: M and B
  std::vector<float> weighted;           ///< per particle: w l
  std::vector<std::uint32_t> keys, scratch, indices, counts;
};

/// Over which particles the normaliser sums.
enum class Psi {
  window,  ///< the window that the likelihood uses: box sum of the cell map (right)
  cell  ///< the single cell, as printed in P-PHD (15)-(16): a straddling cloud counts several times
};

/// Update of particle weights in track-before-detect PHD: M = sum of w l over a cell, B = sum of M
/// over the window around it, w' = w l / (clutter + B), or 0 where that is 0 / 0. P-PHD (14)-(16),
/// with clutter = 1 in ratio units. A particle outside the frame, by the pixel floor(x + .5), or of
/// NaN log ratio has weight 0. Throws std::invalid_argument for arrays of unlike lengths, a frame
/// of more than 65535 pixels a side, a negative window or clutter.
struct CellWeights {
  static constexpr std::string_view name = "cell_weights";
  static constexpr Tolerance tolerance{1e-9, 2e-6};  // float exp and float sums of one sign

  struct Args {
    int width = 0, height = 0, half_width = 2;
    Psi psi = Psi::window;
    float clutter = 1;                 ///< lambda, in likelihood-ratio units
    std::span<const float> x, y;       ///< [px]
    std::span<const float> predicted;  ///< w_{k|k-1}
    std::span<const float>
        log_ratio;                   ///< l = exp(bounded_log_ratio(.)); -inf and NaN mean weight 0
    std::span<float> updated;        ///< written: w_k
    std::span<float> weighted = {};  ///< written if given: w_{k|k-1} l
    CellWorkspace* workspace = nullptr;  ///< runs, M, B are left here for the caller
  };
  static void serial(const Args& args);
  static void tbb(const Args& args, Workers& workers);
  static void egl(const Args& args, gl::Context& context);
  static WholeCall whole(const Args& args);
  static std::vector<std::unique_ptr<Trial>> trials();
};

}  // namespace glint

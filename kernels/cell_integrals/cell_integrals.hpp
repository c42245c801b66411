// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <span>
#include <string_view>
#include <tuple>
#include <vector>

#include "glint/kernels/core/frame.hpp"
#include "glint/kernels/core/trial.hpp"

namespace glint {

/// How pixels become the intensities z_l >= 0 of cells, and which cells have none to show. A pixel
/// that is not finite counts as dark.
struct CellRule {
  float threshold = 0;    ///< pixels that are not above it are dark
  bool subtract = false;  ///< z = pixel - threshold, else z = pixel
  /// Dark cells are truncated, that is, without data, as P-HPMHT (9) prints it, instead of z = 0.
  /// It loses targets; for comparison with the paper.
  bool truncate_dark = false;
  std::span<const Box> missing =
      {};  ///< without data whatever the pixels say; clipped to the frame
};

/// ||Z|| and the number of displayed cells. P-HPMHT (9). Once a frame: it looks at every pixel.
struct CellTotal {
  double norm = 0;   ///< ||Z||, the sum of z over the displayed cells
  double shown = 0;  ///< displayed cells

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.norm, s.shown);
  }

  bool operator==(const CellTotal&) const = default;
};
struct SumCells {
  static constexpr std::string_view name = "sum_cells";
  static constexpr Tolerance tolerance{1e-6, 1e-6};

  struct Args {
    FrameView frame = {};
    CellRule rule = {};
    CellTotal* total = nullptr;  ///< needed; written
  };
  static void serial(const Args& args);
  static void tbb(const Args& args, Workers& workers);
  static void egl(const Args& args, gl::Context& context);
};

/// A Gaussian target as a histogram sees it.
struct HistogramTarget {
  double x = 0, y = 0;              ///< mean [px]
  double sigma_x = 1, sigma_y = 1;  ///< > 0 [px]
  double proportion = 0;            ///< pi_k >= 0
};

/// A target's share of the expected measurements. P-HPMHT (11), (12), (18).
struct TargetSums {
  /// n_k = pi_k sum_l z_l P_kl / P_l, P_l the total probability of the cell: (11) and (12) with
  /// P_tl for the printed P_tk, without which the likelihood falls at every iteration.
  double count = 0;
  double x = 0, y = 0;    ///< synthetic measurement (11) [px]; the target's mean if count is 0
  double xx = 0, yy = 0;  ///< second moments per axis about the target's mean [px^2], (17)-(18);
                          ///< sigma^2 if count is 0. About another point c: xx + (mean - c)^2 +
                          ///< 2 (x - mean) (mean - c)
  double shown = 0;       ///< sum of P_kl over the displayed cells; < 1 at borders
};

/// What is left for the background and the frame as a whole.
struct MixtureSums {
  double background = 0;      ///< n_0
  double shown = 0;           ///< P_t, total probability of the displayed cells, (8)
  double log_likelihood = 0;  ///< sum of z_l log P_l over the displayed cells; only if asked for

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.background, s.shown, s.log_likelihood);
  }
};

/// Memory that cell_integrals keeps from call to call, so that a warm call allocates nothing.
struct IntegralsWorkspace {
  IntegralsWorkspace();
  ~IntegralsWorkspace();
  IntegralsWorkspace(IntegralsWorkspace&&) noexcept;
  IntegralsWorkspace& operator=(IntegralsWorkspace&&) noexcept;

  struct Fast;
  std::vector<double> mixture;  ///< of the reference
  std::unique_ptr<Fast> fast;
};

/// Expectation step of H-PMHT for one frame: cell probabilities of Gaussian targets in closed form,
/// the mixture with a flat background 1/S, and each target's expected count, centroid and second
/// moments. P-HPMHT (6)-(11), (17)-(18). A cell is the pixel [i - .5, i + .5] on both axes. A
/// target's probability is counted within `reach` sigmas of its mean (rounded up to whole pixels)
/// and inside the frame, and is 0 elsewhere, so the cost grows with targets, not with pixels.
/// Cells without data are taken for their expectation, ||Z|| P_l / P_t, (9). A target whose mean
/// is not finite, or whose window misses the frame, counts 0.
/// Throws std::invalid_argument if pi_0, a sigma or the reach is not > 0, a proportion is negative,
/// or `sums` and `targets` are of unlike length.
struct CellIntegrals {
  static constexpr std::string_view name = "cell_integrals";
  static constexpr Tolerance tolerance{1e-6, 2e-5};       ///< of all but the mean
  static constexpr Tolerance mean_tolerance{1e-4, 1e-6};  ///< [px]

  struct Args {
    FrameView frame = {};
    CellRule rule = {};
    CellTotal total = {};   ///< what SumCells says of frame and rule
    double background = 1;  ///< pi_0 > 0
    double cells = 0;       ///< S; 0 means the frame's pixels
    double reach = 5;       ///< half a window [sigmas]
    std::span<const HistogramTarget> targets = {};
    std::span<TargetSums> sums = {};          ///< written, one a target
    MixtureSums* mixture = nullptr;           ///< written if given
    bool log_likelihood = false;              ///< whether `mixture` has it: a logarithm a cell
    IntegralsWorkspace* workspace = nullptr;  ///< the call brings its own if not given
  };
  static void serial(const Args& args);
  static void tbb(const Args& args, Workers& workers);
  static void egl(const Args& args, gl::Context& context);
  static std::vector<std::unique_ptr<Trial>> trials();
};

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>

#include "glint/kernels/cell_integrals/window.hpp"
#include "glint/kernels/core/isa.hpp"

namespace glint {

/// A target as the lanes see it.
struct LaneTarget {
  Box box;          ///< window, clipped to the frame
  float left, top;  ///< first edge of the window, from the mean [px]
  float sigma_x, sigma_y, proportion;
  std::uint32_t index;  ///< among the caller's targets
};

/// The frame and what holds for all of its cells.
struct LaneCells {
  const float* data;
  std::ptrdiff_t pitch;
  int width, height;
  float threshold, offset;  ///< z = pixel - offset above the threshold
  float background;         ///< pi_0 / S
  bool truncate_dark, log_likelihood;
  const Box* missing;
  std::size_t missing_count;
};

/// Integrals of an axis' cells, zeros beyond them up to a multiple of 16; `p` has kProfilePad zeros
/// more on either side.
struct AxisProfile {
  const float *p, *first, *second;
};
struct TargetProfile {
  AxisProfile x, y;
};
inline constexpr int kProfilePad = 16;
/// Widest window, on both axes, that `isolated` takes [px].
inline constexpr int kIsolatedSide = 15;

constexpr std::size_t padded(int n) { return (static_cast<std::size_t>(n) + 15) / 16 * 16; }
/// Floats that the profile of an axis of `n` cells takes, and that of a target.
constexpr std::size_t axis_size(int n) { return 3 * padded(n) + 2 * kProfilePad; }
constexpr std::size_t profile_size(const Box& box) {
  return axis_size(box.x1 - box.x0) + axis_size(box.y1 - box.y0);
}

/// A target whose window meets that of the one at hand.
struct LaneNeighbour {
  const LaneTarget* target;
  TargetProfile profile;
  bool owns;  ///< whether cells of both windows count for this one in the log-likelihood
};

struct CellIntegralsLanes {
  void (*locate)(const HistogramTarget* targets, std::size_t begin, std::size_t end, double reach,
                 int width, int height, LaneTarget* located);
  /// Fills `storage`, profile_size() floats.
  TargetProfile (*profile)(const LaneTarget& target, float* storage);
  /// Sums by the targets' own index. For windows of at most kIsolatedSide pixels a side that meet
  /// no other, all cells with data.
  void (*isolated)(const LaneCells& cells, const LaneTarget* targets, const std::uint32_t* which,
                   std::size_t n, cell_integrals::PartialSums* sums);
  /// For any window. Adds the cells' z log ratios to `log_ratio_sum`. `next`, if any, is the target
  /// that comes after this one.
  void (*crowded)(const LaneCells& cells, const LaneTarget& target, const TargetProfile& profile,
                  const LaneNeighbour* neighbours, std::size_t n, const LaneTarget* next,
                  cell_integrals::PartialSums& sums, double& log_ratio_sum);
  /// Adds z over a stretch of `n` pixels in each of `rows` rows, and those with data.
  void (*sum)(const LaneCells& cells, const float* pixels, int n, int rows, double& norm,
              double& shown);
};
GLINT_DECLARE_LANES(CellIntegralsLanes, cell_integrals_lanes)

}  // namespace glint

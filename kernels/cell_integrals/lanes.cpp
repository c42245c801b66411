// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/cell_integrals/lanes.hpp"

#include "glint/kernels/cell_integrals/lanes_axis.hpp"
#include "glint/kernels/cell_integrals/lanes_blocks.hpp"
#include "glint/kernels/cell_integrals/lanes_sums.hpp"

namespace glint::GLINT_LANES {
namespace {

using cell_integrals::PartialSums;

void locate(const HistogramTarget* targets, std::size_t begin, std::size_t end, double reach,
            int width, int height, LaneTarget* located) {
  for (std::size_t k = begin; k < end; ++k) {
    const HistogramTarget& t = targets[k];
    const Box box = cell_integrals::window_of(t, reach, width, height);
    const bool seen = box.x1 > box.x0;
    located[k] = {box,
                  seen ? static_cast<float>(box.x0 - 0.5 - t.x) : 0.0f,
                  seen ? static_cast<float>(box.y0 - 0.5 - t.y) : 0.0f,
                  static_cast<float>(t.sigma_x),
                  static_cast<float>(t.sigma_y),
                  static_cast<float>(t.proportion),
                  static_cast<std::uint32_t>(k)};
  }
}

TargetProfile profile(const LaneTarget& t, float* storage) {
  const int width = t.box.x1 - t.box.x0, height = t.box.y1 - t.box.y0;
  return {axis_profile(t.left, t.sigma_x, width, storage),
          axis_profile(t.top, t.sigma_y, height, storage + axis_size(width))};
}

GLINT_INLINE void fetch_ahead(const LaneCells& cells, const LaneTarget& t) {
  for (int y = t.box.y0; y < t.box.y1; ++y) {
    const float* row = cells.data + y * cells.pitch;
    __builtin_prefetch(row + t.box.x0);
    __builtin_prefetch(row + t.box.x1 - 1);
  }
}

/// The integrals of a target's columns and rows.
struct TargetAxes {
  Cells columns, rows;
};

/// `Inside` if all sixteen columns may be read.
template <bool Inside>
GLINT_INLINE ColumnSums column_sums(const LaneCells& cells, const LaneTarget& t,
                                    const TargetAxes& axes) {
  alignas(64) float row_p[16], row_first[16], row_second[16];
  store_wide(row_p, axes.rows.p);
  store_wide(row_first, axes.rows.first);
  store_wide(row_second, axes.rows.second);
  const Wide weighted = axes.columns.p * wide(t.proportion), background = wide(cells.background);
  ColumnSums sums;
  const float* pixels = cells.data + t.box.y0 * cells.pitch + t.box.x0;
  for (int y = 0; y < t.box.y1 - t.box.y0; ++y, pixels += cells.pitch) {
    const Wide mixture = multiply_add(weighted, wide(row_p[y]), background);  // P-HPMHT (7)
    const Wide raw = load_pixels(pixels, Inside ? 16 : cells.width - t.box.x0);
    sums.add(intensities(cells, raw) / mixture, row_p[y], row_first[y], row_second[y]);
  }
  return sums;
}

GLINT_INLINE PartialSums isolated_sums(const LaneCells& cells, const LaneTarget& t,
                                       const TargetAxes& axes) {
  const ColumnSums sums = t.box.x0 + 16 <= cells.width ? column_sums<true>(cells, t, axes)
                                                       : column_sums<false>(cells, t, axes);
  double out[5] = {};
  dots(sums, axes.columns, out);
  return {.count = out[0],
          .x = out[1],
          .y = out[2],
          .xx = out[3],
          .yy = out[4],
          .probability = static_cast<double>(total(axes.columns.p)) * total(axes.rows.p)};
}

/// A few targets at a time: first the axes of all, long chains of arithmetic that run side by side
/// while the pixels come into the cache, then the pixels.
void isolated(const LaneCells& cells, const LaneTarget* targets, const std::uint32_t* which,
              std::size_t n, PartialSums* sums) {
  constexpr std::size_t kTogether = 8;
  TargetAxes axes[kTogether];
  for (std::size_t i = 0; i < n && i < kTogether; ++i) fetch_ahead(cells, targets[which[i]]);
  for (std::size_t first = 0; first < n; first += kTogether) {
    const std::size_t end = n - first < kTogether ? n : first + kTogether;
    for (std::size_t i = first; i < end; ++i) {
      if (i + kTogether < n) fetch_ahead(cells, targets[which[i + kTogether]]);
      const LaneTarget& t = targets[which[i]];
      axes[i - first] = {few_cells(t.left, t.sigma_x, t.box.x1 - t.box.x0),
                         few_cells(t.top, t.sigma_y, t.box.y1 - t.box.y0)};
    }
    for (std::size_t i = first; i < end; ++i) {
      const LaneTarget& t = targets[which[i]];
      sums[t.index] = isolated_sums(cells, t, axes[i - first]);
    }
  }
}

void crowded(const LaneCells& cells, const LaneTarget& t, const TargetProfile& profile,
             const LaneNeighbour* neighbours, std::size_t n, const LaneTarget* next,
             PartialSums& sums, double& log_ratio_sum) {
  if (next != nullptr) fetch_ahead(cells, *next);
  const bool plain = !cells.truncate_dark && !cells.log_likelihood && cells.missing_count == 0;
  const BlockSums all = plain ? sum_blocks<true>(cells, t, profile, neighbours, n)
                              : sum_blocks<false>(cells, t, profile, neighbours, n);
  sums = {all.seen[0],
          all.seen[1],
          all.seen[2],
          all.seen[3],
          all.seen[4],
          all.missing[0],
          all.missing[1],
          all.missing[2],
          all.missing[3],
          all.missing[4],
          sum_of(profile.x.p, t.box.x1 - t.box.x0) * sum_of(profile.y.p, t.box.y1 - t.box.y0)};
  log_ratio_sum += all.log_ratio;
}

void sum(const LaneCells& cells, const float* pixels, int n, int rows, double& norm,
         double& shown) {
  if (cells.truncate_dark) return sum_all<Sum::any_counted>(cells, pixels, n, rows, norm, shown);
  if (cells.offset == cells.threshold) {
    return sum_all<Sum::subtracted>(cells, pixels, n, rows, norm, shown);
  }
  sum_all<Sum::kept>(cells, pixels, n, rows, norm, shown);
}

}  // namespace

extern const CellIntegralsLanes cell_integrals_lanes;
const CellIntegralsLanes cell_integrals_lanes{locate, profile, isolated, crowded, sum};

}  // namespace glint::GLINT_LANES

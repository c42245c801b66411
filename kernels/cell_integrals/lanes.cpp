// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/cell_integrals/lanes.hpp"

#include "glint/kernels/cell_integrals/lanes_axis.hpp"
#include "glint/kernels/cell_integrals/wide.hpp"

namespace glint::GLINT_LANES {
namespace {

using cell_integrals::PartialSums;

constexpr float kLargest = 3.4e38f;

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

/// Sixteen pixels, of which `n` may be read.
GLINT_INLINE Wide load_pixels(const float* pixels, int n) {
  return n >= 16 ? load_wide(pixels) : load_wide_first(pixels, n);
}
/// z of sixteen pixels; zero for dark ones and for those not finite.
GLINT_INLINE Wide intensities(const LaneCells& cells, const Wide& raw) {
  Wide z;
  for (int k = 0; k < kParts; ++k) {
    const Part v = raw.part[k];
    z.part[k] = where((v > cells.threshold) & (v <= kLargest), v - cells.offset);
  }
  return z;
}

/// Sums of columns over rows, weighted with the integrals of the rows.
struct ColumnSums {
  Wide p = zero(), first = zero(), second = zero();

  GLINT_INLINE void add(const Wide& weight, float row_p, float row_first, float row_second) {
    for (int k = 0; k < kParts; ++k) {
      const Part w = weight.part[k];
      p.part[k] = fma(w, broadcast<Part>(row_p), p.part[k]);
      first.part[k] = fma(w, broadcast<Part>(row_first), first.part[k]);
      second.part[k] = fma(w, broadcast<Part>(row_second), second.part[k]);
    }
  }
};

// P-HPMHT (10), (11), (17), (18): five dot products.
GLINT_INLINE void dots(const ColumnSums& sums, const Cells& columns, double* out) {
  out[0] += total(sums.p * columns.p);
  out[1] += total(sums.p * columns.first);
  out[2] += total(sums.first * columns.p);
  out[3] += total(sums.p * columns.second);
  out[4] += total(sums.second * columns.p);
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
  for (std::size_t first = 0; first < n; first += kTogether) {
    const std::size_t end = n - first < kTogether ? n : first + kTogether;
    for (std::size_t i = first; i < end; ++i) fetch_ahead(cells, targets[which[i]]);
    for (std::size_t i = first; i < end; ++i) {
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

constexpr int kBlockRows = 64;

/// A block of cells, sixteen columns of at most kBlockRows rows.
struct Block {
  Box box;  ///< inside the target's window
  alignas(64) float mixture[kBlockRows][16];
  alignas(64) float hidden[kBlockRows][16];  ///< 1 for cells without data
  alignas(64) float own[kBlockRows][16];     ///< 1 for cells that count for the likelihood here
};

GLINT_INLINE Box common(const Box& a, const Box& b) {
  return {a.x0 > b.x0 ? a.x0 : b.x0, a.y0 > b.y0 ? a.y0 : b.y0, a.x1 < b.x1 ? a.x1 : b.x1,
          a.y1 < b.y1 ? a.y1 : b.y1};
}

GLINT_INLINE void fill(float (*tile)[16], const Box& block, const Box& part, float value) {
  const Box box = common(block, part);
  for (int y = box.y0; y < box.y1; ++y) {
    for (int x = box.x0; x < box.x1; ++x) tile[y - block.y0][x - block.x0] = value;
  }
}

/// Adds a target's share of the mixture, P-HPMHT (7).
GLINT_INLINE void add_share(Block& block, const LaneTarget& t, const TargetProfile& profile) {
  const Box box = common(block.box, t.box);
  if (box.x0 >= box.x1) return;
  const Wide columns = load_wide(profile.x.p + (block.box.x0 - t.box.x0)) * wide(t.proportion);
  for (int y = box.y0; y < box.y1; ++y) {
    float* const row = block.mixture[y - block.box.y0];
    store_wide(row, multiply_add(columns, wide(profile.y.p[y - t.box.y0]), load_wide(row)));
  }
}

/// What the cells of a block need but for the pixels; `Plain` if all of them have data and nobody
/// asks for the likelihood.
template <bool Plain>
GLINT_INLINE void prepare(Block& block, const LaneCells& cells, const LaneTarget& t,
                          const TargetProfile& profile, const LaneNeighbour* neighbours,
                          std::size_t n) {
  const Wide columns = load_wide(profile.x.p + (block.box.x0 - t.box.x0)) * wide(t.proportion);
  const float* const rows = profile.y.p + (block.box.y0 - t.box.y0);
  const Wide background = wide(cells.background);
  for (int y = 0; y < block.box.y1 - block.box.y0; ++y) {
    store_wide(block.mixture[y], multiply_add(columns, wide(rows[y]), background));
    if (Plain) continue;
    store_wide(block.hidden[y], zero());
    store_wide(block.own[y], zero());
  }
  for (std::size_t i = 0; i < n; ++i) {
    add_share(block, *neighbours[i].target, neighbours[i].profile);
  }
  if (Plain) return;
  fill(block.own, block.box, block.box, 1);
  for (std::size_t i = 0; i < n; ++i) {
    if (neighbours[i].owns) fill(block.own, block.box, neighbours[i].target->box, 0);
  }
  for (std::size_t i = 0; i < cells.missing_count; ++i) {
    fill(block.hidden, block.box, cells.missing[i], 1);
  }
}

/// Sum of z log(P_l S / pi_0) over one row's cells that count here.
GLINT_INLINE double log_ratios(const Wide& z, const float* own, const float* mixture,
                               float background) {
  alignas(64) float value[16], ratio[16];
  store_wide(value, z);
  for (int i = 0; i < 16; ++i) ratio[i] = own[i] * value[i] * math::log(mixture[i] / background);
  return total(load_wide(ratio));
}

/// 1 where a cell has no data; takes those out of z.
GLINT_INLINE Wide hide(const LaneCells& cells, const float* boxes, Wide& z) {
  Wide hidden = load_wide(boxes);
  for (int k = 0; k < kParts; ++k) {
    const Part one = broadcast<Part>(1.0f);
    if (cells.truncate_dark) hidden.part[k] = where(z.part[k] > 0.0f, hidden.part[k], one);
    z.part[k] = where(hidden.part[k] == 0.0f, z.part[k]);
  }
  return hidden;
}

struct BlockSums {
  double seen[5] = {}, missing[5] = {}, log_ratio = 0;
};

template <bool Plain>
GLINT_INLINE void add_block(const Block& block, const LaneCells& cells, const Cells& columns,
                            const AxisProfile& rows, int first_row, BlockSums& out) {
  ColumnSums seen, missing;
  const float* pixels = cells.data + block.box.y0 * cells.pitch + block.box.x0;
  for (int r = 0, j = first_row; r < block.box.y1 - block.box.y0; ++r, ++j) {
    Wide z = intensities(cells, load_pixels(pixels, cells.width - block.box.x0));
    pixels += cells.pitch;
    if (!Plain) {
      const Wide hidden = hide(cells, block.hidden[r], z);
      missing.add(hidden, rows.p[j], rows.first[j], rows.second[j]);
    }
    seen.add(z / load_wide(block.mixture[r]), rows.p[j], rows.first[j], rows.second[j]);
    if (!Plain && cells.log_likelihood) {
      out.log_ratio += log_ratios(z, block.own[r], block.mixture[r], cells.background);
    }
  }
  dots(seen, columns, out.seen);
  if (!Plain) dots(missing, columns, out.missing);
}

GLINT_INLINE double sum_of(const float* values, int n) {
  double sum = 0;
  for (int i = 0; i < n; i += 16) sum += total(load_wide(values + i));
  return sum;
}

template <bool Plain>
GLINT_INLINE BlockSums sum_blocks(const LaneCells& cells, const LaneTarget& t,
                                  const TargetProfile& profile, const LaneNeighbour* neighbours,
                                  std::size_t n) {
  BlockSums all;
  Block block;
  for (int x = t.box.x0; x < t.box.x1; x += 16) {
    const int i = x - t.box.x0;
    const Cells columns{load_wide(profile.x.p + i), load_wide(profile.x.first + i),
                        load_wide(profile.x.second + i)};
    for (int y = t.box.y0; y < t.box.y1; y += kBlockRows) {
      block.box = common({x, y, x + 16, y + kBlockRows}, t.box);
      prepare<Plain>(block, cells, t, profile, neighbours, n);
      add_block<Plain>(block, cells, columns, profile.y, y - t.box.y0, all);
    }
  }
  return all;
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

/// Adds z, and with `CountLit` the displayed cells, of sixteen pixels, of which `n` count.
template <bool CountLit>
GLINT_INLINE void add_cells(const LaneCells& cells, const Wide& raw, int n, Wide& sums, Wide& lit) {
  for (int k = 0; k < kParts; ++k) {
    const Part v = raw.part[k];
    auto is_lit = (v > cells.threshold) & (v <= kLargest);
    if (n < 16) is_lit &= count_from<kLanes>(k * kLanes) < n;
    sums.part[k] += where(is_lit, v - cells.offset);
    if (CountLit) lit.part[k] += where(is_lit, broadcast<Part>(1.0f));
  }
}

/// Rows side by side, so that no sum waits for the one before it.
template <bool CountLit, int Rows>
GLINT_INLINE void sum_rows(const LaneCells& cells, const float* pixels, int n, double& norm,
                           double& shown) {
  Wide sums[Rows], lit[Rows];
  for (int r = 0; r < Rows; ++r) sums[r] = lit[r] = zero();
  int x = 0;
  for (; x + 16 <= n; x += 16) {
    for (int r = 0; r < Rows; ++r) {
      add_cells<CountLit>(cells, load_wide(pixels + r * cells.pitch + x), 16, sums[r], lit[r]);
    }
  }
  for (int r = 0; r < Rows && x < n; ++r) {
    const Wide last = load_wide_first(pixels + r * cells.pitch + x, n - x);
    add_cells<CountLit>(cells, last, n - x, sums[r], lit[r]);
  }
  for (int r = 1; r < Rows; ++r) sums[0] = sums[0] + sums[r], lit[0] = lit[0] + lit[r];
  norm += total(sums[0]);
  shown += CountLit ? total(lit[0]) : static_cast<float>(n * Rows);
}

template <bool CountLit>
GLINT_INLINE void sum_all(const LaneCells& cells, const float* pixels, int n, int rows,
                          double& norm, double& shown) {
  constexpr int kTogether = 4;
  int y = 0;
  for (; y + kTogether <= rows; y += kTogether) {
    sum_rows<CountLit, kTogether>(cells, pixels + y * cells.pitch, n, norm, shown);
  }
  for (; y < rows; ++y) sum_rows<CountLit, 1>(cells, pixels + y * cells.pitch, n, norm, shown);
}

void sum(const LaneCells& cells, const float* pixels, int n, int rows, double& norm,
         double& shown) {
  if (cells.truncate_dark) return sum_all<true>(cells, pixels, n, rows, norm, shown);
  sum_all<false>(cells, pixels, n, rows, norm, shown);
}

}  // namespace

extern const CellIntegralsLanes cell_integrals_lanes;
const CellIntegralsLanes cell_integrals_lanes{locate, profile, isolated, crowded, sum};

}  // namespace glint::GLINT_LANES

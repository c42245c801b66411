// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/kernels/cell_integrals/lanes.hpp"
#include "glint/kernels/cell_integrals/lanes_axis.hpp"
#include "glint/kernels/cell_integrals/lanes_sums.hpp"
#include "glint/kernels/cell_integrals/wide.hpp"
#include "glint/kernels/core/math.hpp"

// Part of lanes.cpp: targets whose windows overlap, block by block of their cells.
namespace glint::GLINT_LANES {
namespace {

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

}  // namespace
}  // namespace glint::GLINT_LANES

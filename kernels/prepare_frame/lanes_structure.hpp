// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/kernels/core/math.hpp"
#include "glint/kernels/prepare_frame/lanes.hpp"
#include "glint/kernels/prepare_frame/lanes_median.hpp"

// Part of lanes.cpp: the background's morphological gradient, dilated.
namespace glint::GLINT_LANES {
namespace {

constexpr int kReach = 3;  // 3x3, then 5x5
constexpr int kStructureWidth = kTileColumns + 2 * kReach;

/// Rows of one tile, kReach columns wider than the tile on both sides.
struct StructureRows {
  alignas(64) float background[3][kStructureWidth + 32];
  alignas(64) float gradient[kStructureWidth + 32];
  alignas(64) float dilated[5][kTileColumns + 32];
};

/// A background row with the edge pixels repeated beyond the frame.
GLINT_INLINE void load_row(const StructurePass& pass, int x0, int n, int y, float* row) {
  const float* from = pass.background + clamped(y, pass.height) * pass.pitch;
  for (int i = 0; i < n; ++i) {
    const int x = x0 + i;
    if (x >= 0 && x < pass.width) {
      const int run = n - i < pass.width - x ? n - i : pass.width - x;
      __builtin_memcpy(row + i, from + x, sizeof(float) * static_cast<std::size_t>(run));
      i += run - 1;
    } else {
      row[i] = from[clamped(x, pass.width)];
    }
  }
}

/// Comparisons with NaN are false, which leaves it out.
GLINT_INLINE float larger(float most, float value) { return value > most ? value : most; }
GLINT_INLINE float smaller(float least, float value) { return value < least ? value : least; }

/// Gradients of one row at columns 1 .. n - 2 of three background rows.
GLINT_INLINE void gradient_row(const float* __restrict a, const float* __restrict b,
                               const float* __restrict c, float* __restrict out, int n) {
  constexpr float kInfinity = __builtin_inff();
  alignas(64) float high[kStructureWidth + 32], low[kStructureWidth + 32];
  for (int i = 0; i < n; ++i) {
    high[i] = larger(larger(larger(-kInfinity, a[i]), b[i]), c[i]);
    low[i] = smaller(smaller(smaller(kInfinity, a[i]), b[i]), c[i]);
  }
  for (int i = 1; i < n - 1; ++i) {
    const float gradient = larger(larger(high[i - 1], high[i]), high[i + 1]) -
                           smaller(smaller(low[i - 1], low[i]), low[i + 1]);
    out[i] = gradient > 0 ? gradient : 0;
  }
}

void structure_tile(const StructurePass& pass, int x0, int x1, int y0, int y1) {
  StructureRows rows;
  const int first = x0 - kReach, n = x1 - x0 + 2 * kReach, width = x1 - x0;
  for (int k = -1; k <= 0; ++k) {
    load_row(pass, first, n, y0 - 2 + k, rows.background[(y0 - 2 + k + 6) % 3]);
  }
  for (int y = y0 - 2; y < y1 + 2; ++y) {
    load_row(pass, first, n, y + 1, rows.background[(y + 1 + 6) % 3]);
    float* dilated = rows.dilated[(y + 5) % 5];
    if (y < 0 || y >= pass.height) {
      for (int i = 0; i < width; ++i) dilated[i] = 0;
    } else {
      gradient_row(rows.background[(y + 5) % 3], rows.background[(y + 6) % 3],
                   rows.background[(y + 7) % 3], rows.gradient, n);
      for (int i = 0; first + i < 0; ++i) rows.gradient[i] = 0;
      for (int i = pass.width - first; i < n; ++i) rows.gradient[i] = 0;
      const float* g = rows.gradient + 1;
      for (int i = 0; i < width; ++i) {
        dilated[i] = larger(larger(larger(larger(g[i], g[i + 1]), g[i + 2]), g[i + 3]), g[i + 4]);
      }
    }
    if (y < y0 + 2) continue;
    float* out = pass.structure + (y - 2) * pass.structure_pitch + x0;
    for (int i = 0; i < width; ++i) {
      const float ab = larger(rows.dilated[0][i], rows.dilated[1][i]);
      const float cd = larger(rows.dilated[2][i], rows.dilated[3][i]);
      out[i] = pass.share * larger(larger(ab, cd), rows.dilated[4][i]);
    }
  }
}

}  // namespace
}  // namespace glint::GLINT_LANES

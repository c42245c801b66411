// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/kernels/cell_integrals/lanes.hpp"
#include "glint/kernels/cell_integrals/lanes_axis.hpp"
#include "glint/kernels/cell_integrals/wide.hpp"

// Part of lanes.cpp: what sixteen pixels of a row show, and sums over rows.
namespace glint::GLINT_LANES {
namespace {

constexpr float kLargest = 3.4e38f;
constexpr float kInfinity = __builtin_inff();

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

/// What sum_rows() adds up: z of pixels that are taken to be finite or NaN, with threshold and
/// offset alike (`subtracted`) or not (`kept`); z of any pixels; and the displayed cells too.
enum class Sum { subtracted, kept, any, any_counted };

template <Sum Kind>
GLINT_INLINE void add_cells(const LaneCells& cells, const Wide& raw, Wide& sums, Wide& lit) {
  for (int k = 0; k < kParts; ++k) {
    const Part v = raw.part[k];
    if constexpr (Kind == Sum::subtracted) {
      sums.part[k] += greater(broadcast<Part>(0.0f), v - cells.threshold);
    } else if constexpr (Kind == Sum::kept) {
      sums.part[k] += where(v > cells.threshold, v - cells.offset);
    } else {
      const auto is_lit = (v > cells.threshold) & (v <= kLargest);
      sums.part[k] += where(is_lit, v - cells.offset);
      if (Kind == Sum::any_counted) lit.part[k] += where(is_lit, broadcast<Part>(1.0f));
    }
  }
}

/// The first `n` < 16 pixels, then some that are dark under any threshold.
GLINT_INLINE Wide load_last(const float* pixels, int n) {
  Wide raw = load_wide_first(pixels, n);
  for (int k = 0; k < kParts; ++k) {
    raw.part[k] =
        where(count_from<kLanes>(k * kLanes) < n, raw.part[k], broadcast<Part>(-kInfinity));
  }
  return raw;
}

/// Rows side by side, so that no sum waits for the one before it.
template <Sum Kind, int Rows>
GLINT_INLINE void sum_rows(const LaneCells& cells, const float* pixels, int n, double& norm,
                           double& shown) {
  Wide sums[Rows], lit[Rows];
  for (int r = 0; r < Rows; ++r) sums[r] = lit[r] = zero();
  int x = 0;
  for (; x + 16 <= n; x += 16) {
    for (int r = 0; r < Rows; ++r) {
      add_cells<Kind>(cells, load_wide(pixels + r * cells.pitch + x), sums[r], lit[r]);
    }
  }
  for (int r = 0; r < Rows && x < n; ++r) {
    add_cells<Kind>(cells, load_last(pixels + r * cells.pitch + x, n - x), sums[r], lit[r]);
  }
  for (int r = 1; r < Rows; ++r) sums[0] = sums[0] + sums[r], lit[0] = lit[0] + lit[r];
  const float sum = total(sums[0]);
  if constexpr (Kind == Sum::subtracted || Kind == Sum::kept) {
    // An infinite pixel, which is dark, was added: look again.
    if (sum > kLargest) return sum_rows<Sum::any, Rows>(cells, pixels, n, norm, shown);
  }
  norm += sum;
  shown += Kind == Sum::any_counted ? total(lit[0]) : static_cast<float>(n * Rows);
}

template <Sum Kind>
GLINT_INLINE void sum_all(const LaneCells& cells, const float* pixels, int n, int rows,
                          double& norm, double& shown) {
  constexpr int kTogether = 4;
  int y = 0;
  for (; y + kTogether <= rows; y += kTogether) {
    sum_rows<Kind, kTogether>(cells, pixels + y * cells.pitch, n, norm, shown);
  }
  for (; y < rows; ++y) sum_rows<Kind, 1>(cells, pixels + y * cells.pitch, n, norm, shown);
}

}  // namespace
}  // namespace glint::GLINT_LANES

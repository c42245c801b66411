// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/kernels/core/vectors.hpp"
#include "glint/kernels/pixel_likelihood/lanes.hpp"

/// A few rows of the map in one sweep from left to right: vertical taps from loads, horizontal taps
/// from shifted registers, so that a pixel is read from memory once and written once.
namespace glint::GLINT_LANES::pixel_likelihood {

/// Rows that a sweep makes.
inline constexpr int kRows = 4;
using V = Floats<kLanes>;

/// What a sweep reads and writes; null for rows that the frame or the map lacks.
template <class T, int H>
struct Rows {
  const T* in[kRows + 2 * H];  ///< from H rows above the first on
  float* out[kRows];
  float energy[kRows];  ///< -I^2 / 2 times the row's share of B
};

/// Column sums left of and at the current columns.
struct Sums {
  V before[kRows], at[kRows];
};

/// Constants of a frame in registers.
template <int H>
struct Taps {
  V offset, gain, threshold;
  V relative[H + 1];
};

template <int H, class T>
GLINT_INLINE Taps<H> make_taps(const PixelPass<T>& pass) {
  Taps<H> taps{
      broadcast<V>(pass.offset), broadcast<V>(pass.gain), broadcast<V>(pass.threshold), {}};
  for (int k = 1; k <= H; ++k) taps.relative[k] = broadcast<V>(pass.relative[k]);
  return taps;
}

/// Sum of squared weights along an axis of `size` pixels for windows around pixels x, x + 1, ...
template <int H>
GLINT_INLINE V clipped_energy(const float* squared, int x, int size) {
  const Ints<kLanes> at = count_from<kLanes>(x);
  V sum = broadcast<V>(squared[0]);
#pragma GCC unroll 7
  for (int k = 1; k <= H; ++k) {
    sum += where(at >= k, broadcast<V>(squared[k]));
    sum += where(at < size - k, broadcast<V>(squared[k]));
  }
  return sum;
}

/// Sum of 2 H + 1 values weighted symmetrically about z[H].
template <int H>
GLINT_INLINE V weighted(const V* z, const Taps<H>& taps) {
  V sum = z[H];
#pragma GCC unroll 7
  for (int k = 1; k <= H; ++k) sum = fma(z[H - k] + z[H + k], taps.relative[k], sum);
  return sum;
}

template <int H>
GLINT_INLINE void column_sums(const V* z, const Taps<H>& taps, V* sums) {
#pragma GCC unroll 4
  for (int k = 0; k < kRows; ++k) sums[k] = weighted<H>(z + k, taps);
}

/// Column sums at x, for columns and rows that the frame has. A float frame's offset is 0 here.
template <class T, int H>
GLINT_INLINE void inner_sums(const Rows<T, H>& rows, int x, const Taps<H>& taps, V* sums) {
  V z[kRows + 2 * H];
#pragma GCC unroll 18
  for (int k = 0; k < kRows + 2 * H; ++k) {
    z[k] = load<kLanes>(rows.in[k] + x);
    if constexpr (sizeof(T) == 2) z[k] -= taps.offset;
  }
  column_sums<H>(z, taps, sums);
}

/// Column sums at x, of which the frame has the first `n` columns and perhaps not all rows.
template <class T, int H>
[[gnu::noinline]] void edge_sums(const Rows<T, H>& rows, int x, int n, const Taps<H>& taps,
                                 V* sums) {
  V z[kRows + 2 * H] = {};
#pragma GCC unroll 18
  for (int k = 0; n >= kLanes && k < kRows + 2 * H; ++k) {
    if (rows.in[k] != nullptr) z[k] = load<kLanes>(rows.in[k] + x) - taps.offset;
  }
  const Ints<kLanes> inside = count_from<kLanes>(0) < n;
  for (int k = 0; n > 0 && n < kLanes && k < kRows + 2 * H; ++k) {
    if (rows.in[k] == nullptr) continue;
    z[k] = where(inside, load_first<kLanes>(rows.in[k] + x, n) - taps.offset);
  }
  column_sums<H>(z, taps, sums);
}

/// Correlation of sweep row k at the current columns, given the column sums right of them.
template <int H>
GLINT_INLINE V correlate(const Sums& sums, int k, V after, const Taps<H>& taps) {
  V row[2 * H + 1];
  row[H] = sums.at[k];
  [&]<int... I>(std::integer_sequence<int, I...>) __attribute__((always_inline)) {
    ((row[H - 1 - I] = window<kLanes - 1 - I>(sums.before[k], sums.at[k]),
      row[H + 1 + I] = window<1 + I>(sums.at[k], after)),
     ...);
  }
  (std::make_integer_sequence<int, H>{});
  return weighted<H>(row, taps);
}

GLINT_INLINE void advance(Sums& sums, const V* after) {
#pragma GCC unroll 4
  for (int k = 0; k < kRows; ++k) sums.before[k] = sums.at[k], sums.at[k] = after[k];
}

}  // namespace glint::GLINT_LANES::pixel_likelihood

// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/pixel_likelihood/lanes.hpp"

#include "glint/kernels/pixel_likelihood/hit_sink.hpp"
#include "glint/kernels/pixel_likelihood/sweep.hpp"

namespace glint::GLINT_LANES {
namespace pixel_likelihood {
namespace {

enum class Map { none, store, stream };

/// One step at columns that the frame's edge cuts or touches, or in rows that it does.
template <class T, int H>
[[gnu::noinline]] void edge_step(const PixelPass<T>& pass, const Rows<T, H>& rows, int x,
                                 Sums& sums, HitSink& sink) {
  const Taps<H> taps = make_taps<H>(pass);
  const int n = pass.width - x < kLanes ? pass.width - x : kLanes;
  const V energy = clipped_energy<H>(pass.squared, x, pass.width);
  V after[kRows], value[kRows];
  edge_sums(rows, x + kLanes, pass.width - x - kLanes, taps, after);
  std::uint64_t hit = 0;
#pragma GCC unroll 4
  for (int k = 0; k < kRows; ++k) {
    value[k] = fma(correlate(sums, k, after[k], taps), taps.gain, energy * rows.energy[k]);
    hit |= std::uint64_t{above(value[k], taps.threshold) & first_lanes(n)} << (k * kLanes);
    if (rows.out[k] != nullptr) store_first(rows.out[k] + x, value[k], n);
  }
  if (hit != 0) collect(sink, value, hit, x);
  advance(sums, after);
}

template <int H, class T>
GLINT_INLINE void set_energy(const PixelPass<T>& pass, const float* of_rows, int x, V* energy) {
  const V columns = clipped_energy<H>(pass.squared, x, pass.width);
  for (int k = 0; k < kRows; ++k) energy[k] = columns * of_rows[k];
}

/// All steps of rows whose windows the frame has from top to bottom; at least two vectors wide.
template <Map M, class T, int H>
GLINT_INLINE void whole_steps(const PixelPass<T>& pass, const Rows<T, H>& rows, HitSink& sink) {
  const Taps<H> taps = make_taps<H>(pass);
  Sums sums{};
  V energy[kRows];
  set_energy<H>(pass, rows.energy, 0, energy);
  inner_sums(rows, 0, taps, sums.at);
  for (int x = 0; x < pass.width; x += kLanes) {
    const int right = pass.width - x - kLanes;  // columns right of the current ones
    V after[kRows], value[kRows];
    if (right >= kLanes) {
      inner_sums(rows, x + kLanes, taps, after);
    } else {
      edge_sums(rows, x + kLanes, right, taps, after);
    }
    if (x == kLanes || right < kLanes) set_energy<H>(pass, rows.energy, x, energy);
    std::uint64_t hit = 0;
#pragma GCC unroll 4
    for (int k = 0; k < kRows; ++k) {
      value[k] = fma(correlate(sums, k, after[k], taps), taps.gain, energy[k]);
      hit |= std::uint64_t{above(value[k], taps.threshold)} << (k * kLanes);
    }
    if (M != Map::none && right < 0) {
      for (int k = 0; k < kRows; ++k) store_first(rows.out[k] + x, value[k], right + kLanes);
    } else {
#pragma GCC unroll 4
      for (int k = 0; k < kRows; ++k) {
        if constexpr (M == Map::store) store(rows.out[k] + x, value[k]);
        if constexpr (M == Map::stream) stream(rows.out[k] + x, value[k]);
      }
    }
    advance(sums, after);
#pragma GCC unroll 4
    for (int k = 1; k <= kRows; ++k) {  // the rows that the next sweep adds
      __builtin_prefetch(rows.in[kRows + 2 * H - 1] + k * pass.pitch + x);
    }
    if (__builtin_expect(hit != 0, 0)) {
      V hits[kRows];
      for (int k = 0; k < kRows; ++k) hits[k] = value[k];
      if (right < 0) hit &= every_row(first_lanes(right + kLanes));
      collect(sink, hits, hit, x);
    }
  }
}

template <Map M, class T, int H>
[[gnu::noinline]] void sweep(const PixelPass<T>& pass, int y, int count, HitSink& sink) {
  Rows<T, H> rows{};
  bool whole = count == kRows && pass.width >= 2 * kLanes;
  if constexpr (sizeof(T) == 4) whole = whole && pass.offset == 0;
  for (int k = 0; k < kRows + 2 * H; ++k) {
    const int row = y - H + k;
    if (row >= 0 && row < pass.height) rows.in[k] = pass.frame + row * pass.pitch;
    whole = whole && rows.in[k] != nullptr;
  }
  for (int k = 0; k < count; ++k) {
    if constexpr (M != Map::none) rows.out[k] = pass.map + (y + k) * pass.map_pitch;
    rows.energy[k] = pass.energy_gain * clipped_energy<H>(pass.squared, y + k, pass.height)[0];
  }
  if (whole) return whole_steps<M>(pass, rows, sink);
  Sums sums{};
  edge_sums(rows, 0, pass.width, make_taps<H>(pass), sums.at);
  for (int x = 0; x < pass.width; x += kLanes) edge_step(pass, rows, x, sums, sink);
}

template <class T, int H>
GLINT_INLINE void sweep_map(const PixelPass<T>& pass, int y, int rows, HitSink& sink) {
  if (pass.map == nullptr) return sweep<Map::none, T, H>(pass, y, rows, sink);
  if (pass.stream) return sweep<Map::stream, T, H>(pass, y, rows, sink);
  sweep<Map::store, T, H>(pass, y, rows, sink);
}

/// A sweep meets hits column by column: they wait in a buffer to be put row by row. When there are
/// too many for it, the rows are swept once more each, which meets them in order.
template <class T, int H>
std::size_t rows(const PixelPass<T>& pass, int y0, int y1, Hit* hits, std::size_t capacity) {
  Hit buffer[kHitBuffer];
  HitSink out{hits, capacity, 0, 0, 0, 0};
  for (int y = y0; y < y1; y += kRows) {
    const int n = y1 - y < kRows ? y1 - y : kRows;
    HitSink mixed{buffer, kHitBuffer, 0, y, 0, n};
    sweep_map<T, H>(pass, y, n, mixed);
    if (mixed.count <= kHitBuffer) {
      for (int k = 0; k < n; ++k) move_row(mixed, y + k, out);
      continue;
    }
    out.y = y;
    for (int k = 0; k < n; ++k) {
      out.first = k, out.last = k + 1;
      sweep<Map::none, T, H>(pass, y, n, out);
    }
  }
  if (pass.stream) fence();
  return out.count;
}

}  // namespace
}  // namespace pixel_likelihood

#define GLINT_EACH_HALF_WIDTH(T)                                                                  \
  {                                                                                               \
    pixel_likelihood::rows<T, 0>, pixel_likelihood::rows<T, 1>, pixel_likelihood::rows<T, 2>,     \
        pixel_likelihood::rows<T, 3>, pixel_likelihood::rows<T, 4>, pixel_likelihood::rows<T, 5>, \
        pixel_likelihood::rows<T, 6>, pixel_likelihood::rows<T, 7>                                \
  }
extern const PixelLikelihoodLanes pixel_likelihood_lanes;
const PixelLikelihoodLanes pixel_likelihood_lanes{GLINT_EACH_HALF_WIDTH(float),
                                                  GLINT_EACH_HALF_WIDTH(std::uint16_t)};

}  // namespace glint::GLINT_LANES

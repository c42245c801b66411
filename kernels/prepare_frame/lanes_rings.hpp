// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/kernels/core/math.hpp"
#include "glint/kernels/core/vectors.hpp"
#include "glint/kernels/prepare_frame/lanes.hpp"
#include "glint/kernels/prepare_frame/whiten.hpp"

// Part of lanes.cpp: sums of a residual's energy over rings, moved down a tile row by row. Energies
// are whole numbers, so that running sums lose nothing and do not depend on where a tile begins.
namespace glint::GLINT_LANES {
namespace {

constexpr int kRingRows = 2 * Whiten::kMaxRing + 2;
/// Room before a row's first column, so that the sum of nothing has a place.
constexpr int kLead = 16;
constexpr int kRingWidth = kLead + kTileColumns + 2 * Whiten::kMaxRing + 64;

// Not `using`: g++ drops the attribute of a dependent type there.
typedef std::uint32_t Words __attribute__((vector_size(4 * kLanes)));  // NOLINT

/// Box sums of one quantity, moved down row by row. A row holds the sums from its first column, x0
/// - outer, up to each column, at kLead + column; they may run over, differences of them are right.
struct RingSums {
  alignas(64) std::uint32_t rows[kRingRows][kRingWidth];
  alignas(64) std::uint32_t outer[kRingWidth], inner[kRingWidth];  ///< sums of the rows in a box
};

struct WhitenTile {
  const WhitenPass* pass;
  int x0, x1, y0, y1;
  int left, right;  ///< columns of the energies that lie in the frame
  bool masked;      ///< some pixel of the tile or its surroundings is not known
  RingSums energy, known;
  alignas(64) std::uint32_t entering[kRingWidth];             ///< a row before it is summed up
  alignas(64) std::int32_t outer_columns[kTileColumns + 32];  ///< columns of the frame in a box
  alignas(64) std::int32_t inner_columns[kTileColumns + 32];
  alignas(64) float mean_factor[kTileColumns + 32];
  alignas(64) float noise[kTileColumns + 32], z[kTileColumns + 32];
  alignas(64) float no_structure[kTileColumns + 32];
};

GLINT_INLINE int columns(const WhitenTile& t) { return t.x1 - t.x0 + 2 * t.pass->outer; }

GLINT_INLINE std::uint32_t* ring_row(const WhitenTile& t, RingSums& sums, int y) {
  const int period = 2 * t.pass->outer + 2;
  return sums.rows[(y + 4 * period) % period];
}

/// Asks for n floats before they are needed: a tile's rows are too short for the machine to
/// foresee.
GLINT_INLINE void ask_for(const float* row, int n) {
  for (int i = 0; i < n; i += 16) __builtin_prefetch(row + i);
}

/// Asks for what the sweep reads below row y.
GLINT_INLINE void ask_ahead(const WhitenTile& t, int y) {
  constexpr int kAhead = 2;
  const WhitenPass& p = *t.pass;
  const int width = t.x1 - t.x0, entering = y + p.outer + kAhead, leaving = y + kAhead;
  if (entering >= 0 && entering < p.height) {
    ask_for(p.image + entering * p.image_pitch + t.x0, width);
    ask_for(p.background + entering * p.background_pitch + t.x0, width);
  }
  if (p.structure != nullptr && leaving >= t.y0 && leaving < t.y1) {
    ask_for(p.structure + leaving * p.structure_pitch + t.x0, width);
  }
}

/// Energies of row y of the frame; true if a pixel is not known.
GLINT_INLINE bool read_energies(WhitenTile& t, int y) {
  const WhitenPass& p = *t.pass;
  const float* __restrict image = p.image + y * p.image_pitch + t.x0 - p.outer;
  const float* __restrict background = p.background + y * p.background_pitch + t.x0 - p.outer;
  std::uint32_t* __restrict energy = t.entering;
  const float inverse = p.inverse_sigma, scale = p.energy_scale, cap = p.energy_cap;
  const int left = t.left, right = t.right;
  std::int32_t unknown = 0;
  for (int i = left; i < right; ++i) {
    const float r = (image[i] - background[i]) * inverse;
    const float e = r * r * scale;
    const float clipped = e < cap ? e : cap;
    const std::int32_t known = r == r ? -1 : 0;
    // Not lround(): e is not negative, and this becomes vectors.
    // NOLINTNEXTLINE(bugprone-incorrect-roundings)
    energy[i] = static_cast<std::uint32_t>(static_cast<std::int32_t>(clipped + 0.5f) & known);
    unknown |= ~known;
  }
  return unknown != 0;
}

GLINT_INLINE void read_known(WhitenTile& t, int y) {
  const WhitenPass& p = *t.pass;
  const float* __restrict image = p.image + y * p.image_pitch + t.x0 - p.outer;
  const float* __restrict background = p.background + y * p.background_pitch + t.x0 - p.outer;
  std::uint32_t* __restrict known = t.entering;
  const int left = t.left, right = t.right;
  for (int i = left; i < right; ++i) {
    const float r = image[i] - background[i];
    known[i] = r == r ? 1 : 0;
  }
}

/// Sums from lane 0 up to each lane.
GLINT_INLINE Words sums_up(Words v) {
  const Words zero{};
  v += window<kLanes - 1>(zero, v);
  v += window<kLanes - 2>(zero, v);
  v += window<kLanes - 4>(zero, v);
  if constexpr (kLanes > 8) v += window<kLanes - 8>(zero, v);
  return v;
}

/// Puts the sums along the entering row into `row`.
GLINT_INLINE void sum_along(const WhitenTile& t, std::uint32_t* row) {
  Words carry{};
  for (int i = 0; i < columns(t); i += kLanes) {
    Words v;
    __builtin_memcpy(&v, t.entering + i, sizeof v);
    v = sums_up(v);
    const Words total = broadcast<Words>(v[kLanes - 1]);
    v += carry;
    carry += total;
    __builtin_memcpy(row + kLead + i, &v, sizeof v);
  }
}

/// Lets row y into the sums; nothing lies outside the frame. True if a pixel is not known.
bool enter_row(WhitenTile& t, int y) {
  if (y < 0 || y >= t.pass->height) {
    const auto bytes = sizeof(std::uint32_t) * static_cast<std::size_t>(kLead + columns(t));
    __builtin_memset(ring_row(t, t.energy, y), 0, bytes);
    if (t.masked) __builtin_memset(ring_row(t, t.known, y), 0, bytes);
    return false;
  }
  const bool unknown = read_energies(t, y);
  sum_along(t, ring_row(t, t.energy, y));
  if (t.masked) {
    read_known(t, y);
    sum_along(t, ring_row(t, t.known, y));
  }
  return unknown;
}

/// Moves the boxes down to output row y: rows up to y + outer have entered.
GLINT_INLINE void move_down(const WhitenTile& t, RingSums& sums, int y) {
  const int outer = t.pass->outer, inner = t.pass->inner, n = kLead + columns(t);
  const std::uint32_t* __restrict in = ring_row(t, sums, y + outer);
  const std::uint32_t* __restrict out = ring_row(t, sums, y - outer - 1);
  const std::uint32_t* __restrict inner_in = ring_row(t, sums, y + inner);
  const std::uint32_t* __restrict inner_out = ring_row(t, sums, y - inner - 1);
  std::uint32_t* __restrict outer_sum = sums.outer;
  std::uint32_t* __restrict inner_sum = sums.inner;
  for (int i = 0; i < n; ++i) {
    outer_sum[i] += in[i] - out[i];
    inner_sum[i] += inner_in[i] - inner_out[i];
  }
}

/// Where the sums of the two boxes about tile column 0 begin and end.
struct RingEnds {
  const std::uint32_t *outer_end, *outer_begin, *inner_end, *inner_begin;

  GLINT_INLINE RingEnds(const RingSums& sums, const WhitenPass& p)
      : outer_end(sums.outer + kLead + 2 * p.outer),
        outer_begin(sums.outer + kLead - 1),
        inner_end(sums.inner + kLead + p.outer + p.inner),
        inner_begin(sums.inner + kLead + p.outer - p.inner - 1) {}
  GLINT_INLINE std::int32_t ring(int i) const {
    return static_cast<std::int32_t>(outer_end[i] - outer_begin[i] - inner_end[i] + inner_begin[i]);
  }
};

}  // namespace
}  // namespace glint::GLINT_LANES

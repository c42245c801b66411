// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/kernels/core/math.hpp"
#include "glint/kernels/core/vectors.hpp"
#include "glint/kernels/prepare_frame/lanes.hpp"
#include "glint/kernels/prepare_frame/whiten.hpp"

// Part of lanes.cpp: noise sigma and z of one tile, in one sweep down the rows. Energies are whole
// numbers, so that running sums lose nothing and do not depend on where a tile begins.
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

/// Pixels of a window about i that lie in [0, size).
GLINT_INLINE int inside(int i, int half, int size) {
  return (i + half < size ? i + half + 1 : size) - (i > half ? i - half : 0);
}

/// 1 / (pixels in the ring * energy of one sigma), for row y of a frame without masked pixels.
GLINT_INLINE void count_rings(WhitenTile& t, int y) {
  const WhitenPass& p = *t.pass;
  const int outer_rows = inside(y, p.outer, p.height), inner_rows = inside(y, p.inner, p.height);
  const std::int32_t* __restrict outer = t.outer_columns;
  const std::int32_t* __restrict inner = t.inner_columns;
  float* __restrict factor = t.mean_factor;
  const float scale = p.energy_scale;
  const int width = t.x1 - t.x0;
  for (int i = 0; i < width; ++i) {
    const std::int32_t count = outer_rows * outer[i] - inner_rows * inner[i];
    const float inverse = 1 / (static_cast<float>(count) * scale);
    factor[i] = count > 0 ? inverse : 0;
  }
}

GLINT_INLINE void count_columns(WhitenTile& t) {
  const WhitenPass& p = *t.pass;
  for (int i = 0; i < t.x1 - t.x0; ++i) {
    t.outer_columns[i] = inside(t.x0 + i, p.outer, p.width);
    t.inner_columns[i] = inside(t.x0 + i, p.inner, p.width);
  }
}

GLINT_INLINE void count_known(WhitenTile& t) {
  const float scale = t.pass->energy_scale;
  const RingEnds known(t.known, *t.pass);
  float* __restrict factor = t.mean_factor;
  const int width = t.x1 - t.x0;
  for (int i = 0; i < width; ++i) {
    const std::int32_t count = known.ring(i);
    const float inverse = 1 / (static_cast<float>(count) * scale);
    factor[i] = count > 0 ? inverse : 0;
  }
}

GLINT_INLINE bool same_counts(const WhitenPass& p, int y, int before) {
  return inside(y, p.outer, p.height) == inside(before, p.outer, p.height) &&
         inside(y, p.inner, p.height) == inside(before, p.inner, p.height);
}

/// Noise sigma of row y, the largest of the frame's, the ring's and the structure's, and z.
GLINT_INLINE void whiten_row(WhitenTile& t, int y) {
  const WhitenPass& p = *t.pass;
  const RingEnds energy(t.energy, p);
  const float* structure =
      p.structure == nullptr ? t.no_structure : p.structure + y * p.structure_pitch + t.x0;
  const float* image = p.image + y * p.image_pitch + t.x0;
  const float* background = p.background + y * p.background_pitch + t.x0;
  const float* __restrict factor = t.mean_factor;
  float* __restrict noise = t.noise;
  float* __restrict z = t.z;
  const float sigma = p.sigma, offset = p.offset, low = p.clip_low, high = p.clip_high;
  const std::int32_t keep = p.keep_bits, flip = p.flip_bits;
  const int width = t.x1 - t.x0;
  for (int i = 0; i < width; ++i) {
    const float ring = sigma * __builtin_sqrtf(static_cast<float>(energy.ring(i)) * factor[i]);
    const float calm = ring > sigma ? ring : sigma;
    noise[i] = structure[i] > calm ? structure[i] : calm;
    const float r = image[i] - background[i];
    const float turned = math::from_bits((math::bits(r) & keep) ^ flip);
    const float whitened = math::clamp(turned / noise[i] - offset, low, high);
    z[i] = r == r ? whitened : 0.0f;
  }
}

GLINT_INLINE void put_row(const WhitenTile& t, int y) {
  const WhitenPass& p = *t.pass;
  const int width = t.x1 - t.x0;
  float* out = p.whitened + y * p.whitened_pitch + t.x0;
  int i = 0;
  for (; p.stream && i + kLanes <= width; i += kLanes) stream(out + i, load<kLanes>(t.z + i));
  __builtin_memcpy(out + i, t.z + i, sizeof(float) * static_cast<std::size_t>(width - i));
}

GLINT_INLINE void keep_noise(const WhitenTile& t, int y) {
  const WhitenPass& p = *t.pass;
  if (p.noise == nullptr || y % p.noise_step != 0) return;
  const int first = (t.x0 + p.noise_step - 1) / p.noise_step * p.noise_step;
  const float* image = p.image + y * p.image_pitch;
  const float* background = p.background + y * p.background_pitch;
  float* noise = p.noise + y / p.noise_step * p.noise_pitch;
  for (int x = first; x < t.x1; x += p.noise_step) {
    const float r = image[x] - background[x];
    noise[x / p.noise_step] = r == r ? t.noise[x - t.x0] : __builtin_nanf("");
  }
}

GLINT_INLINE void clear(const WhitenTile& t, RingSums& sums) {
  const auto bytes = sizeof(std::uint32_t) * static_cast<std::size_t>(kLead + columns(t));
  for (int k = 0; k < 2 * t.pass->outer + 2; ++k) __builtin_memset(sums.rows[k], 0, bytes);
  __builtin_memset(sums.outer, 0, bytes);
  __builtin_memset(sums.inner, 0, bytes);
}

/// False if a masked pixel turned up in a tile that was taken for one without.
bool sweep_rows(WhitenTile& t) {
  const int outer = t.pass->outer;
  int counted = -1;
  clear(t, t.energy);
  if (t.masked) clear(t, t.known);
  for (int y = t.y0 - 2 * outer; y < t.y1; ++y) {
    ask_ahead(t, y);
    const bool found = enter_row(t, y + outer);
    if (found && !t.masked) return false;
    move_down(t, t.energy, y);
    if (t.masked) move_down(t, t.known, y);
    if (y < t.y0) continue;
    if (t.masked) {
      count_known(t);
    } else if (counted < 0 || !same_counts(*t.pass, y, counted)) {
      count_rings(t, y);
      counted = y;
    }
    whiten_row(t, y);
    put_row(t, y);
    keep_noise(t, y);
  }
  return true;
}

void sweep_without_rings(WhitenTile& t) {
  clear(t, t.energy);
  for (int i = 0; i < t.x1 - t.x0; ++i) t.mean_factor[i] = 0;
  for (int y = t.y0; y < t.y1; ++y) {
    whiten_row(t, y);
    put_row(t, y);
    keep_noise(t, y);
  }
}

void whiten_tile(const WhitenPass& pass, int x0, int x1, int y0, int y1) {
  WhitenTile t;
  t.pass = &pass;
  t.x0 = x0, t.x1 = x1, t.y0 = y0, t.y1 = y1;
  t.masked = false;
  t.left = x0 < pass.outer ? pass.outer - x0 : 0;
  t.right = pass.width - x0 + pass.outer;
  if (t.right > columns(t)) t.right = columns(t);
  __builtin_memset(t.entering, 0, sizeof t.entering);
  __builtin_memset(t.no_structure, 0, sizeof t.no_structure);
  count_columns(t);
  if (pass.outer == 0) {
    sweep_without_rings(t);
  } else if (!sweep_rows(t)) {
    t.masked = true;
    sweep_rows(t);
  }
  if (pass.stream) fence();
}

}  // namespace
}  // namespace glint::GLINT_LANES

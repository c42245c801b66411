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
constexpr int kRingWidth = kTileColumns + 2 * Whiten::kMaxRing + 32;

/// Box sums of one quantity, moved down row by row: columns are indexed from x0 - outer.
struct RingSums {
  alignas(64) std::int32_t rows[kRingRows][kRingWidth];
  alignas(64) std::int32_t outer[kRingWidth], inner[kRingWidth];  ///< sums down the columns
  alignas(64) std::int32_t ring[kTileColumns + 32];               ///< outer box less inner box
};

struct WhitenTile {
  const WhitenPass* pass;
  int x0, x1, y0, y1;
  int left, right;  ///< columns of the energies that lie in the frame
  bool masked;      ///< some pixel of the tile or its surroundings is not known
  RingSums energy, known;
  alignas(64) float mean_factor[kTileColumns + 32];
  alignas(64) float noise[kTileColumns + 32], z[kTileColumns + 32];
};

GLINT_INLINE std::int32_t* ring_row(const WhitenTile& t, RingSums& sums, int y) {
  const int period = 2 * t.pass->outer + 2;
  return sums.rows[(y + 4 * period) % period];
}

/// Energies of row y, and which of its pixels are known; nothing outside the frame. True if a pixel
/// is not known.
bool enter_row(WhitenTile& t, int y) {
  const WhitenPass& p = *t.pass;
  const int columns = t.x1 - t.x0 + 2 * p.outer;
  std::int32_t* __restrict energy = ring_row(t, t.energy, y);
  std::int32_t* __restrict known = ring_row(t, t.known, y);
  if (y < 0 || y >= p.height) {
    __builtin_memset(energy, 0, sizeof(std::int32_t) * static_cast<std::size_t>(columns));
    __builtin_memset(known, 0, sizeof(std::int32_t) * static_cast<std::size_t>(columns));
    return false;
  }
  const float* __restrict image = p.image + y * p.image_pitch + t.x0 - p.outer;
  const float* __restrict background = p.background + y * p.background_pitch + t.x0 - p.outer;
  const float inverse = p.inverse_sigma, scale = p.energy_scale, cap = p.energy_cap;
  std::int32_t unknown = 0;
  for (int i = t.left; i < t.right; ++i) {
    const float r = (image[i] - background[i]) * inverse;
    const float e = r * r * scale;
    const float clipped = e < cap ? e : cap;
    const bool is_known = r == r;
    energy[i] = is_known ? static_cast<std::int32_t>(clipped + 0.5f) : 0;
    unknown |= is_known ? 0 : 1;
  }
  if (!t.masked) return unknown != 0;
  for (int i = t.left; i < t.right; ++i) {
    const float r = image[i] - background[i];
    known[i] = r == r ? 1 : 0;
  }
  return unknown != 0;
}

/// sums[i] += window sum of n columns from i on, by doubling.
GLINT_INLINE void add_windows(const std::int32_t* columns, int n, int sign, std::int32_t* sums,
                              int width) {
  alignas(64) std::int32_t doubled[2][kRingWidth];
  const std::int32_t* from = columns;
  int offset = 0, left = width + n, which = 0;
  for (int span = 1; span <= n; span *= 2) {
    if ((n & span) != 0) {
      const std::int32_t* __restrict part = from + offset;
      std::int32_t* __restrict to = sums;
      for (int i = 0; i < width; ++i) to[i] += sign * part[i];
      offset += span;
    }
    if (2 * span > n) break;
    left -= span;
    std::int32_t* __restrict to = doubled[which];
    const std::int32_t* __restrict a = from;
    const std::int32_t* __restrict b = from + span;
    for (int i = 0; i < left; ++i) to[i] = a[i] + b[i];
    from = to;
    which = 1 - which;
  }
}

/// Moves the boxes down to output row y: outer rows y - outer .. y + outer have entered.
GLINT_INLINE void move_down(const WhitenTile& t, RingSums& sums, int y, int columns) {
  const int outer = t.pass->outer, inner = t.pass->inner;
  const std::int32_t* __restrict in = ring_row(t, sums, y + outer);
  const std::int32_t* __restrict out = ring_row(t, sums, y - outer - 1);
  const std::int32_t* __restrict inner_in = ring_row(t, sums, y + inner);
  const std::int32_t* __restrict inner_out = ring_row(t, sums, y - inner - 1);
  for (int i = 0; i < columns; ++i) {
    sums.outer[i] += in[i] - out[i];
    sums.inner[i] += inner_in[i] - inner_out[i];
  }
}

GLINT_INLINE void sum_rings(const WhitenTile& t, RingSums& sums) {
  const int width = t.x1 - t.x0, outer = t.pass->outer, inner = t.pass->inner;
  for (int i = 0; i < width; ++i) sums.ring[i] = 0;
  add_windows(sums.outer, 2 * outer + 1, 1, sums.ring, width);
  add_windows(sums.inner + outer - inner, 2 * inner + 1, -1, sums.ring, width);
}

/// Pixels of a window about i that lie in [0, size).
GLINT_INLINE int inside(int i, int half, int size) {
  return (i + half < size ? i + half + 1 : size) - (i > half ? i - half : 0);
}

/// 1 / (pixels in the ring * energy of one sigma), for row y of a frame without masked pixels.
GLINT_INLINE void count_rings(WhitenTile& t, int y) {
  const WhitenPass& p = *t.pass;
  const int outer = inside(y, p.outer, p.height), inner = inside(y, p.inner, p.height);
  for (int i = 0; i < t.x1 - t.x0; ++i) {
    const int x = t.x0 + i;
    const int count = outer * inside(x, p.outer, p.width) - inner * inside(x, p.inner, p.width);
    t.mean_factor[i] = count > 0 ? 1 / (static_cast<float>(count) * p.energy_scale) : 0;
  }
}

GLINT_INLINE void count_known(WhitenTile& t) {
  const float scale = t.pass->energy_scale;
  for (int i = 0; i < t.x1 - t.x0; ++i) {
    const std::int32_t count = t.known.ring[i];
    t.mean_factor[i] = count > 0 ? 1 / (static_cast<float>(count) * scale) : 0;
  }
}

GLINT_INLINE bool same_counts(const WhitenPass& p, int y, int before) {
  return inside(y, p.outer, p.height) == inside(before, p.outer, p.height) &&
         inside(y, p.inner, p.height) == inside(before, p.inner, p.height);
}

/// Noise sigma of row y: the largest of the frame's, the ring's and the structure's.
GLINT_INLINE void noise_row(WhitenTile& t, int y) {
  const WhitenPass& p = *t.pass;
  const int width = t.x1 - t.x0;
  for (int i = 0; i < width; ++i) {
    const float mean = static_cast<float>(t.energy.ring[i]) * t.mean_factor[i];
    const float ring = p.sigma * __builtin_sqrtf(mean);
    t.noise[i] = ring > p.sigma ? ring : p.sigma;
  }
  if (p.structure == nullptr) return;
  const float* structure = p.structure + y * p.structure_pitch + t.x0;
  for (int i = 0; i < width; ++i) {
    t.noise[i] = structure[i] > t.noise[i] ? structure[i] : t.noise[i];
  }
}

GLINT_INLINE void z_row(WhitenTile& t, int y) {
  const WhitenPass& p = *t.pass;
  const int width = t.x1 - t.x0;
  const float* image = p.image + y * p.image_pitch + t.x0;
  const float* background = p.background + y * p.background_pitch + t.x0;
  for (int i = 0; i < width; ++i) {
    const float r = image[i] - background[i];
    const float turned = math::from_bits((math::bits(r) & p.keep_bits) ^ p.flip_bits);
    const float z = math::clamp(turned / t.noise[i] - p.offset, p.clip_low, p.clip_high);
    t.z[i] = r == r ? z : 0.0f;
  }
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
  const int outer = t.pass->outer;
  const auto bytes = sizeof(std::int32_t) * static_cast<std::size_t>(t.x1 - t.x0 + 2 * outer);
  for (int k = 0; k < 2 * outer + 2; ++k) __builtin_memset(sums.rows[k], 0, bytes);
  __builtin_memset(sums.outer, 0, bytes);
  __builtin_memset(sums.inner, 0, bytes);
}

/// False if a masked pixel turned up in a tile that was taken for one without.
bool sweep_rows(WhitenTile& t) {
  const int outer = t.pass->outer, columns = t.x1 - t.x0 + 2 * outer;
  int counted = -1;
  for (int y = t.y0 - 2 * outer; y < t.y1; ++y) {
    const bool found = enter_row(t, y + outer);
    if (found && !t.masked) return false;
    move_down(t, t.energy, y, columns);
    if (t.masked) move_down(t, t.known, y, columns);
    if (y < t.y0) continue;
    sum_rings(t, t.energy);
    if (t.masked) {
      sum_rings(t, t.known);
      count_known(t);
    } else if (counted < 0 || !same_counts(*t.pass, y, counted)) {
      count_rings(t, y);
      counted = y;
    }
    noise_row(t, y);
    z_row(t, y);
    keep_noise(t, y);
  }
  return true;
}

void sweep_without_rings(WhitenTile& t) {
  for (int i = 0; i < t.x1 - t.x0; ++i) t.energy.ring[i] = 0, t.mean_factor[i] = 0;
  for (int y = t.y0; y < t.y1; ++y) {
    noise_row(t, y);
    z_row(t, y);
    keep_noise(t, y);
  }
}

void whiten_tile(const WhitenPass& pass, int x0, int x1, int y0, int y1) {
  WhitenTile t;
  t.pass = &pass;
  t.x0 = x0, t.x1 = x1, t.y0 = y0, t.y1 = y1;
  t.masked = false;
  if (pass.outer == 0) return sweep_without_rings(t);
  t.left = x0 < pass.outer ? pass.outer - x0 : 0;
  t.right = pass.width - x0 + pass.outer;
  if (t.right > x1 - x0 + 2 * pass.outer) t.right = x1 - x0 + 2 * pass.outer;
  clear(t, t.energy);
  if (sweep_rows(t)) return;
  t.masked = true;
  clear(t, t.energy);
  clear(t, t.known);
  sweep_rows(t);
}

}  // namespace
}  // namespace glint::GLINT_LANES

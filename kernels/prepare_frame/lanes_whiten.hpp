// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/kernels/core/math.hpp"
#include "glint/kernels/core/vectors.hpp"
#include "glint/kernels/prepare_frame/lanes_rings.hpp"

// Part of lanes.cpp: noise sigma and z of one tile, in one sweep down the rows.
namespace glint::GLINT_LANES {
namespace {

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

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "glint/kernels/core/inline.hpp"
#include "glint/kernels/core/math.hpp"

namespace glint {

/// What a draw is for. With the seed and the frame it is the address of a stream of draws: two uses
/// in one frame never share a purpose. Append only: a number's meaning is part of the results.
enum class Purpose : std::uint32_t {
  propagate = 1,
  switch_model = 2,
  jitter = 3,
  birth = 4,
  resample = 5,
  sensor_noise = 6,
  added_noise = 7,
  scenario = 8,
  clutter = 9,
  trial = 10,
  birth_jitter = 11,
  kmeans = 12,
  spawn = 13,
};

/// Address of a stream of draws; the item (particle, pixel, ...) and the draw index complete it.
struct RandomKey {
  std::uint64_t seed = 0;
  std::uint32_t frame = 0;
  std::uint32_t purpose = 0;
};
inline RandomKey random_key(std::uint64_t seed, std::uint64_t frame, Purpose purpose) {
  return {seed, static_cast<std::uint32_t>(frame), static_cast<std::uint32_t>(purpose)};
}

struct Words4 {
  std::uint32_t w[4];
};
struct Normals4 {
  float n[4];
};

/// Rounds that Glint draws with: the fewest that pass BigCrush (Salmon et al., SC'11, table 2).
inline constexpr int kThreefryRounds = 12;

GLINT_INLINE std::uint32_t rotate_left(std::uint32_t x, int n) {
  return (x << n) | (x >> (32 - n));
}

/// Threefry4x32 of `Rounds` rounds (Salmon et al., SC'11): a pure function of counter and key.
template <int Rounds>
GLINT_INLINE Words4 threefry(Words4 counter, Words4 key) {
  constexpr int kRotation[8][2] = {{10, 26}, {11, 21}, {13, 27}, {23, 5},
                                   {6, 20},  {17, 11}, {25, 10}, {18, 20}};
  const std::uint32_t k[5] = {key.w[0], key.w[1], key.w[2], key.w[3],
                              0x1BD11BDAu ^ key.w[0] ^ key.w[1] ^ key.w[2] ^ key.w[3]};
  std::uint32_t x0 = counter.w[0] + k[0], x1 = counter.w[1] + k[1];
  std::uint32_t x2 = counter.w[2] + k[2], x3 = counter.w[3] + k[3];
#pragma GCC unroll 20
  for (int r = 0; r < Rounds; ++r) {
    const int a = kRotation[r & 7][0], b = kRotation[r & 7][1];
    if (r & 1) {
      x0 += x3, x3 = rotate_left(x3, a) ^ x0;
      x2 += x1, x1 = rotate_left(x1, b) ^ x2;
    } else {
      x0 += x1, x1 = rotate_left(x1, a) ^ x0;
      x2 += x3, x3 = rotate_left(x3, b) ^ x2;
    }
    if ((r & 3) == 3) {
      const int s = r / 4 + 1;
      x0 += k[s % 5], x1 += k[(s + 1) % 5], x2 += k[(s + 2) % 5];
      x3 += k[(s + 3) % 5] + static_cast<std::uint32_t>(s);
    }
  }
  return {{x0, x1, x2, x3}};
}

/// Four random words of (key, item, draw): the same on any thread, device and instruction set.
GLINT_INLINE Words4 random_words(RandomKey key, std::uint32_t item, std::uint32_t draw = 0) {
  return threefry<kThreefryRounds>(
      {{item, draw, key.frame, key.purpose}},
      {{static_cast<std::uint32_t>(key.seed), static_cast<std::uint32_t>(key.seed >> 32), 0, 0}});
}

/// Uniform in (0, 1): 24 bits, centred.
GLINT_INLINE float uniform(std::uint32_t word) {
  return math::fma(static_cast<float>(static_cast<std::int32_t>(word >> 8)), 0x1p-24f, 0x1p-25f);
}

/// Box-Muller: two words to two standard normals.
GLINT_INLINE void normal_pair(std::uint32_t a, std::uint32_t b, float& n0, float& n1) {
  const float radius = __builtin_sqrtf(-2.0f * math::log(uniform(a)));
  const auto [s, c] =
      math::sincos_turns(static_cast<float>(static_cast<std::int32_t>(b >> 8)) * 0x1p-24f);
  n0 = radius * c;
  n1 = radius * s;
}

/// Four standard normals of (key, item, draw).
GLINT_INLINE Normals4 random_normals(RandomKey key, std::uint32_t item, std::uint32_t draw = 0) {
  const Words4 r = random_words(key, item, draw);
  Normals4 out{};
  normal_pair(r.w[0], r.w[1], out.n[0], out.n[1]);
  normal_pair(r.w[2], r.w[3], out.n[2], out.n[3]);
  return out;
}

}  // namespace glint

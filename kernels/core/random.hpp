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
  cue = 14,
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

struct Normals4 {
  float n[4];
};

#include "glint/kernels/core/random.glsl"

/// Threefry4x32 of `Rounds` rounds.
template <int Rounds>
GLINT_INLINE Words4 threefry(Words4 counter, Words4 key) {
  return threefry_rounds(Rounds, counter, key);
}

/// The key as words of 32 bits, which the device has too.
GLINT_INLINE KeyWords words_of(RandomKey key) {
  return {static_cast<uint>(key.seed), static_cast<uint>(key.seed >> 32), key.frame, key.purpose};
}

/// Four random words of (key, item, draw): the same on any thread, device and instruction set.
GLINT_INLINE Words4 random_words(RandomKey key, std::uint32_t item, std::uint32_t draw = 0) {
  return keyed_words(words_of(key), item, draw);
}

/// Uniform in (0, 1): 24 bits, centred.
GLINT_INLINE float uniform(std::uint32_t word) { return uniform_of(word); }

/// Box-Muller: two words to two standard normals.
GLINT_INLINE void normal_pair(std::uint32_t a, std::uint32_t b, float& n0, float& n1) {
  const NormalPair pair = normals_of(a, b);
  n0 = pair.n0;
  n1 = pair.n1;
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

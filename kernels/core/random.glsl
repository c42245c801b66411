// SPDX-License-Identifier: Apache-2.0
// C++ and GLSL: the generator of random words, and what uniforms and normals are made of. C++ reads
// it inside glint, GLSL after math.glsl.
struct Words4 {
  uint w[4];
};
struct KeyWords {
  uint seed_low, seed_high, frame, purpose;
};
struct NormalPair {
  float n0, n1;
};

// Rounds that Glint draws with: the fewest that pass BigCrush (Salmon et al., SC'11, table 2).
const int kThreefryRounds = 12;

GLINT_INLINE uint rotate_left(uint x, int n) { return (x << n) | (x >> (32 - n)); }

// Threefry4x32 (Salmon et al., SC'11): a pure function of counter and key.
GLINT_INLINE Words4 threefry_rounds(int rounds, Words4 counter, Words4 key) {
  const int rotation[16] = {10, 26, 11, 21, 13, 27, 23, 5, 6, 20, 17, 11, 25, 10, 18, 20};
  const uint k[5] = {key.w[0], key.w[1], key.w[2], key.w[3],
                     0x1BD11BDAu ^ key.w[0] ^ key.w[1] ^ key.w[2] ^ key.w[3]};
  uint x0 = counter.w[0] + k[0], x1 = counter.w[1] + k[1];
  uint x2 = counter.w[2] + k[2], x3 = counter.w[3] + k[3];
#pragma GCC unroll 20
  for (int r = 0; r < rounds; ++r) {
    const int a = rotation[2 * (r & 7)], b = rotation[2 * (r & 7) + 1];
    if ((r & 1) != 0) {
      x0 += x3, x3 = rotate_left(x3, a) ^ x0;
      x2 += x1, x1 = rotate_left(x1, b) ^ x2;
    } else {
      x0 += x1, x1 = rotate_left(x1, a) ^ x0;
      x2 += x3, x3 = rotate_left(x3, b) ^ x2;
    }
    if ((r & 3) == 3) {
      const int s = r / 4 + 1;
      x0 += k[s % 5], x1 += k[(s + 1) % 5], x2 += k[(s + 2) % 5];
      x3 += k[(s + 3) % 5] + uint(s);
    }
  }
  Words4 words;
  words.w[0] = x0, words.w[1] = x1, words.w[2] = x2, words.w[3] = x3;
  return words;
}

// Four random words of (key, item, draw).
GLINT_INLINE Words4 keyed_words(KeyWords key, uint item, uint draw) {
  Words4 counter, seed;
  counter.w[0] = item, counter.w[1] = draw, counter.w[2] = key.frame, counter.w[3] = key.purpose;
  seed.w[0] = key.seed_low, seed.w[1] = key.seed_high, seed.w[2] = 0u, seed.w[3] = 0u;
  return threefry_rounds(kThreefryRounds, counter, seed);
}

// Uniform in (0, 1): 24 bits, centred.
GLINT_INLINE float uniform_of(uint word) {
  return GLINT_MATH(fma)(float(int(word >> 8)), 5.9604644775390625e-08f, 2.98023223876953125e-08f);
}

// Box-Muller: two words to two standard normals.
GLINT_INLINE NormalPair normals_of(uint a, uint b) {
  GLINT_PRECISE const float radius = GLINT_MATH(sqrt)(-2.0f * GLINT_MATH(log)(uniform_of(a)));
  const GLINT_MATH(SinCos) angle =
      GLINT_MATH(sincos_turns)(float(int(b >> 8)) * 5.9604644775390625e-08f);
  NormalPair pair;
  pair.n0 = radius * angle.cos;
  pair.n1 = radius * angle.sin;
  return pair;
}

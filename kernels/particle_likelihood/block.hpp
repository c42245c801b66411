// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/kernels/core/math.hpp"
#include "glint/kernels/core/vectors.hpp"
#include "glint/kernels/particle_likelihood/lanes.hpp"
#include "glint/kernels/particle_likelihood/position.hpp"

/// The steps of a block of particles before its pixels are read.
namespace glint::GLINT_LANES::particle_likelihood {

namespace position = glint::particle_likelihood;
using V = Floats<kLanes>;
using I = Ints<kLanes>;

/// Particles that go through the steps together: their arrays stay in the first cache.
inline constexpr int kBlock = 64;

/// Where a block's particles are along one axis.
struct alignas(64) Axis {
  float coordinate[kBlock];
  std::int32_t pixel[kBlock];  ///< that holds the particle; 0 if none does
  float offset[kBlock];        ///< from its centre; 0 if none holds it
  std::int32_t seen[kBlock];   ///< all bits if one does, else 0
  std::int32_t first, last;    ///< smallest and largest pixel
};

GLINT_INLINE void jitter(const ParticlePass& pass, std::size_t begin, Axis& x, Axis& y) {
  for (int i = 0; i < kBlock; ++i) {
    const Words4 words =
        random_words(pass.key, static_cast<std::uint32_t>(begin) + static_cast<std::uint32_t>(i));
    float n0, n1;
    normal_pair(words.w[0], words.w[1], n0, n1);
    x.coordinate[i] = position::jittered(x.coordinate[i], pass.jitter, n0);
    y.coordinate[i] = position::jittered(y.coordinate[i], pass.jitter, n1);
  }
}

/// position.hpp, many at a time.
GLINT_INLINE void locate(Axis& axis, int size) {
  const V limit = broadcast<V>(static_cast<float>(size));
  I first = broadcast<I>(size), last{};
#pragma GCC unroll 1
  for (int i = 0; i < kBlock; i += kLanes) {
    const V coordinate = load<kLanes>(axis.coordinate + i), edge = coordinate + 0.5f;
    const I seen = (edge >= 0.0f) & (edge < limit);
    const I pixel = __builtin_convertvector(where(seen, edge), I);
    store(axis.pixel + i, pixel);
    store(axis.offset + i, where(seen, coordinate - __builtin_convertvector(pixel, V)));
    store(axis.seen + i, seen);
    first = where(pixel < first, pixel, first);
    last = where(pixel > last, pixel, last);
  }
  axis.first = size, axis.last = 0;
  for (int i = 0; i < kLanes; ++i) {
    axis.first = first[i] < axis.first ? first[i] : axis.first;
    axis.last = last[i] > axis.last ? last[i] : axis.last;
  }
}

/// Weights of the window's pixels, from -H to H, by particle.
template <int H>
struct alignas(64) Weights {
  float of[2 * H + 1][kBlock];
  float energy[kBlock];  ///< sum of their squares
};

template <int H, int Terms>
GLINT_INLINE void polynomial_weights(const WeightPolynomials& p, const Axis& axis,
                                     Weights<H>& weights) {
  for (int i = 0; i < kBlock; i += kLanes) {
    const V offset = load<kLanes>(axis.offset + i), square = offset * offset;
#pragma GCC unroll 8
    for (int k = 0; k <= H; ++k) {
      V even = broadcast<V>(p.even[k][Terms - 1]), odd = broadcast<V>(p.odd[k][Terms - 2]);
#pragma GCC unroll 8
      for (int d = Terms - 2; d >= 0; --d) {
        even = fma(even, square, broadcast<V>(p.even[k][d]));
        if (d < Terms - 2) odd = fma(odd, square, broadcast<V>(p.odd[k][d]));
      }
      if (k > 0) store(weights.of[H - k] + i, fma(-offset, odd, even));
      store(weights.of[H + k] + i, k > 0 ? fma(offset, odd, even) : even);
    }
  }
}

template <int H>
GLINT_INLINE void erf_weights(float scale, const Axis& axis, Weights<H>& weights) {
  for (int i = 0; i < kBlock; ++i) {
    float below = math::erf((-static_cast<float>(H) - 0.5f - axis.offset[i]) * scale);
    for (int k = 0; k <= 2 * H; ++k) {
      const float above = math::erf((static_cast<float>(k - H) + 0.5f - axis.offset[i]) * scale);
      weights.of[k][i] = 0.5f * (above - below);
      below = above;
    }
  }
}

/// Windows are clipped at the frame's edge: pixels beyond it weigh nothing.
template <int H>
GLINT_INLINE void clip(const Axis& axis, int size, Weights<H>& weights) {
  if (axis.first >= H && axis.last < size - H) return;
  for (int k = 0; k <= 2 * H; ++k) {
    for (int i = 0; i < kBlock; ++i) {
      const std::int32_t pixel = axis.pixel[i] + k - H;
      weights.of[k][i] = pixel >= 0 && pixel < size ? weights.of[k][i] : 0.0f;
    }
  }
}

template <int H>
GLINT_INLINE void weigh(const WeightPolynomials& p, const Axis& axis, int size,
                        Weights<H>& weights) {
  if (p.terms == kFewTerms) {
    polynomial_weights<H, kFewTerms>(p, axis, weights);
  } else if (p.terms == kMaxTerms) {
    polynomial_weights<H, kMaxTerms>(p, axis, weights);
  } else {
    erf_weights(p.scale, axis, weights);
  }
  clip(axis, size, weights);
  for (int i = 0; i < kBlock; i += kLanes) {
    V energy{};
#pragma GCC unroll 15
    for (int k = 0; k <= 2 * H; ++k) {
      const V weight = load<kLanes>(weights.of[k] + i);
      energy = fma(weight, weight, energy);
    }
    store(weights.energy + i, energy);
  }
}

}  // namespace glint::GLINT_LANES::particle_likelihood

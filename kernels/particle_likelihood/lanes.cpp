// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/particle_likelihood/lanes.hpp"

#include "glint/kernels/particle_likelihood/block.hpp"
#include "glint/kernels/particle_likelihood/transpose.hpp"

namespace glint::GLINT_LANES {
namespace particle_likelihood {
namespace {

/// Rows apart from which a block's windows are asked for ahead: a frame's worth is not in cache.
constexpr int kSpread = 64;

/// Fills the block's coordinates; those beyond the `count` particles are outside every frame.
GLINT_INLINE void read(const float* from, int count, Axis& axis) {
  for (int i = 0; i < count; ++i) axis.coordinate[i] = from[i];
  for (int i = count; i < kBlock; ++i) axis.coordinate[i] = -1.0f;
}

template <int H>
GLINT_INLINE void prefetch(const ParticlePass& pass, const Axis& x, const Axis& y) {
  for (int i = 0; i < kBlock; ++i) {
    const float* centre = pass.frame + y.pixel[i] * pass.pitch + x.pixel[i];
#pragma GCC unroll 15
    for (int l = -H; l <= H; ++l) __builtin_prefetch(centre + l * pass.pitch);
  }
}

/// A, the sum of weight times z, of particles i to i + 7: their windows' rows are summed with the
/// pixels as lanes, then turned so that the particles are lanes for the sum over columns. No
/// gathers.
template <int H>
GLINT_INLINE Floats<8> matched(const ParticlePass& pass, const Axis& x, const Axis& y,
                               const Weights<H>& columns, const Weights<H>& rows, int i) {
  Floats<8> sum{};
#pragma GCC unroll 2
  for (int half = 0; half < 2 * H + 1; half += 8) {
    Floats<8> window[8];
#pragma GCC unroll 8
    for (int q = 0; q < 8; ++q) {
      const float* corner =
          pass.frame + (y.pixel[i + q] - H) * pass.pitch + x.pixel[i + q] - H + half;
      window[q] = load<8>(corner) * rows.of[0][i + q];
#pragma GCC unroll 14
      for (int l = 1; l <= 2 * H; ++l) {
        window[q] = fma(load<8>(corner + l * pass.pitch), broadcast<Floats<8>>(rows.of[l][i + q]),
                        window[q]);
      }
    }
    transpose(window);
    const int columns_left = 2 * H + 1 - half;
    for (int k = 0; k < (columns_left < 8 ? columns_left : 8); ++k) {
      sum = fma(window[k], load<8>(columns.of[half + k] + i), sum);
    }
  }
  return sum;
}

/// P-PHD (13): I A - I^2 B / 2.
template <int H>
GLINT_INLINE void finish(const ParticlePass& pass, std::size_t begin, int count, const Axis& x,
                         const Axis& y, const Weights<H>& columns, const Weights<H>& rows,
                         const float* sums) {
  const V impossible = broadcast<V>(-__builtin_inff());
  for (int i = 0; i < count; i += kLanes) {
    const int n = count - i < kLanes ? count - i : kLanes;
    const V intensity = load_first<kLanes>(pass.intensity + begin + i, n);
    const V energy = load<kLanes>(columns.energy + i) * load<kLanes>(rows.energy + i);
    const V ratio = intensity * fma(-0.5f * intensity, energy, load<kLanes>(sums + i));
    // The difference of a number and itself is 0 if it is finite.
    const I seen =
        load<kLanes>(x.seen + i) & load<kLanes>(y.seen + i) & (intensity - intensity == 0.0f);
    store_first(pass.log_ratio + begin + i, where(seen, ratio, impossible), n);
  }
}

template <int H>
[[gnu::noinline]] void block(const ParticlePass& pass, std::size_t begin, int count) {
  Axis x, y;
  read(pass.x + begin, count, x);
  read(pass.y + begin, count, y);
  if (pass.jitter > 0) jitter(pass, begin, x, y);
  locate(x, pass.width);
  locate(y, pass.height);
  if (y.last - y.first >= kSpread) prefetch<H>(pass, x, y);
  Weights<H> columns, rows;
  weigh(pass.weights, x, pass.width, columns);
  weigh(pass.weights, y, pass.height, rows);
  alignas(64) float sums[kBlock];
  for (int i = 0; i < count; i += 8) store(sums + i, matched(pass, x, y, columns, rows, i));
  finish(pass, begin, count, x, y, columns, rows, sums);
}

template <int H>
void range(const ParticlePass& pass, std::size_t begin, std::size_t end) {
  for (; begin < end; begin += kBlock) {
    block<H>(pass, begin, end - begin < kBlock ? static_cast<int>(end - begin) : kBlock);
  }
}

}  // namespace
}  // namespace particle_likelihood

extern const ParticleLikelihoodLanes particle_likelihood_lanes;
const ParticleLikelihoodLanes particle_likelihood_lanes{
    {particle_likelihood::range<0>, particle_likelihood::range<1>, particle_likelihood::range<2>,
     particle_likelihood::range<3>, particle_likelihood::range<4>, particle_likelihood::range<5>,
     particle_likelihood::range<6>, particle_likelihood::range<7>}};

}  // namespace glint::GLINT_LANES

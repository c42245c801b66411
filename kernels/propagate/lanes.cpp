// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/propagate/lanes.hpp"

#include "glint/kernels/propagate/draws.hpp"

namespace glint::GLINT_LANES {
namespace {

using math::fma;
using propagate::Arrays;
using propagate::kBlock;
using propagate::kPlainTerms;
using propagate::kTerms;
using propagate::Move;
using propagate::Step;

/// One block of particles, in the first cache.
struct State {
  alignas(64) float x[kBlock], y[kBlock], vx[kBlock], vy[kBlock], intensity[kBlock], ax[kBlock],
      ay[kBlock];
  alignas(64) std::uint32_t mode[kBlock];
};

/// Standard normals of one block: two per axis, then the third of CA, then the intensity's.
struct Noise {
  alignas(64) float x[kBlock], vx[kBlock], y[kBlock], vy[kBlock], ax[kBlock], ay[kBlock],
      intensity[kBlock];
};

GLINT_INLINE void draw_motion(RandomKey key, std::uint32_t first, Noise& noise) {
  for (std::uint32_t j = 0; j < kBlock; ++j) {
    const Normals4 n = random_normals(key, first + j);
    noise.x[j] = n.n[0];
    noise.vx[j] = n.n[1];
    noise.y[j] = n.n[2];
    noise.vy[j] = n.n[3];
  }
}

GLINT_INLINE void draw_acceleration(RandomKey key, std::uint32_t first, Noise& noise) {
  constexpr std::uint32_t kItems = kBlock / 2;
  for (std::uint32_t j = 0; j < kItems; ++j) {
    const Normals4 n = random_normals(key, first / 2 + j, propagate::kAccelerationDraw);
    noise.ax[j] = n.n[0];
    noise.ay[j] = n.n[1];
    noise.ax[kItems + j] = n.n[2];
    noise.ay[kItems + j] = n.n[3];
  }
}

GLINT_INLINE void draw_intensity(RandomKey key, std::uint32_t first, Noise& noise) {
  constexpr std::uint32_t kItems = kBlock / 4;
  for (std::uint32_t j = 0; j < kItems; ++j) {
    const Normals4 n = random_normals(key, first / 4 + j, propagate::kIntensityDraw);
    noise.intensity[j] = n.n[0];
    noise.intensity[kItems + j] = n.n[1];
    noise.intensity[2 * kItems + j] = n.n[2];
    noise.intensity[3 * kItems + j] = n.n[3];
  }
}

GLINT_INLINE void scale(const float* factor, std::uint32_t count, float* normals) {
  for (std::uint32_t j = 0; j < count; ++j) normals[j] *= factor[j];
}

// Q' = q Q. P-PHD (21).
void scale_noise(const float* factor, std::uint32_t count, bool accelerates, Noise& noise) {
  scale(factor, count, noise.x);
  scale(factor, count, noise.vx);
  scale(factor, count, noise.y);
  scale(factor, count, noise.vy);
  scale(factor, count, noise.intensity);
  if (!accelerates) return;
  scale(factor, count, noise.ax);
  scale(factor, count, noise.ay);
}

// I' = I + w_I, reflected. P-PHD (34).
GLINT_INLINE void walk_intensity(const Step& step, const Noise& noise, State& s) {
  const float deviation = step.transition.intensity_deviation;
  const float low = step.intensity_low, high = step.intensity_high;
  for (std::uint32_t j = 0; j < kBlock; ++j) {
    float value = fma(deviation, noise.intensity[j], s.intensity[j]);
    value = value < low ? 2 * low - value : value;
    value = value > high ? 2 * high - value : value;
    s.intensity[j] = math::clamp(value, low, high);
  }
}

// x' = F x + w of particle j. P-PHD (31), (32).
template <bool kAccelerates>
GLINT_INLINE void move_one(const Move<float>& m, const Noise& n, std::uint32_t j, State& s) {
  const float vx = s.vx[j], vy = s.vy[j];
  float x = fma(m.xx, n.x[j], fma(-m.across, vy, fma(m.along, vx, s.x[j])));
  float y = fma(m.xx, n.y[j], fma(m.across, vx, fma(m.along, vy, s.y[j])));
  float new_vx = fma(m.vv, n.vx[j], fma(m.vx, n.x[j], fma(-m.sine, vy, m.cosine * vx)));
  float new_vy = fma(m.vv, n.vy[j], fma(m.vx, n.y[j], fma(m.sine, vx, m.cosine * vy)));
  if constexpr (kAccelerates) {
    const float ax = s.ax[j], ay = s.ay[j];
    x = fma(m.half, ax, x);
    y = fma(m.half, ay, y);
    new_vx = fma(m.time, ax, new_vx);
    new_vy = fma(m.time, ay, new_vy);
    s.ax[j] = fma(m.aa, n.ax[j], fma(m.av, n.vx[j], fma(m.ax, n.x[j], ax)));
    s.ay[j] = fma(m.aa, n.ay[j], fma(m.av, n.vy[j], fma(m.ax, n.y[j], ay)));
  }
  s.x[j] = x;
  s.y[j] = y;
  s.vx[j] = new_vx;
  s.vy[j] = new_vy;
}

template <bool kAccelerates>
GLINT_INLINE void move_all(const Move<float>& move, const Noise& noise, State& s) {
  const Move<float> m = move;
  for (std::uint32_t j = 0; j < kBlock; ++j) move_one<kAccelerates>(m, noise, j, s);
}

/// mode' = how many cumulative probabilities of the mode's row lie at or below a uniform.
void switch_modes(const Step& step, std::uint32_t first, State& s) {
  constexpr std::uint32_t kItems = kBlock / 4;
  alignas(64) float u[kBlock], threshold[kBlock];
  alignas(64) std::uint32_t next[kBlock] = {};
  for (std::uint32_t j = 0; j < kItems; ++j) {
    const Words4 words = random_words(step.switch_key, first / 4 + j);
    for (std::uint32_t k = 0; k < 4; ++k) u[k * kItems + j] = uniform(words.w[k]);
  }
  const auto last = static_cast<std::uint32_t>(step.transition.modes - 1);
  for (std::uint32_t to = 0; to < last; ++to) {
    for (float& t : threshold) t = step.transition.cumulative[last][to];
    for (std::uint32_t from = 0; from < last; ++from) {
      const float t = step.transition.cumulative[from][to];
      for (std::uint32_t j = 0; j < kBlock; ++j)
        threshold[j] = s.mode[j] == from ? t : threshold[j];
    }
    for (std::uint32_t j = 0; j < kBlock; ++j) next[j] += u[j] >= threshold[j] ? 1u : 0u;
  }
  for (std::uint32_t j = 0; j < kBlock; ++j) s.mode[j] = next[j];
}

/// Every particle's own move: blends instead of branches.
template <bool kAccelerates>
void move_by_mode(const Step& step, const Noise& noise, State& s) {
  constexpr int kUsed = kAccelerates ? kTerms : kPlainTerms;
  alignas(64) float terms[kUsed][kBlock];
  static_assert(sizeof(Move<float>) == kTerms * sizeof(float));
  for (int term = 0; term < kUsed; ++term) {
    const float* table = &step.transition.move[0].along + term;
    for (float& t : terms[term]) t = table[0];
    for (int m = 1; m < step.transition.modes; ++m) {
      const float value = table[m * kTerms];
      const auto mode = static_cast<std::uint32_t>(m);
      for (std::uint32_t j = 0; j < kBlock; ++j) {
        terms[term][j] = s.mode[j] == mode ? value : terms[term][j];
      }
    }
  }
  for (std::uint32_t j = 0; j < kBlock; ++j) {
    Move<float> m{};
    m.along = terms[0][j], m.across = terms[1][j], m.cosine = terms[2][j], m.sine = terms[3][j];
    m.xx = terms[4][j], m.vx = terms[5][j], m.vv = terms[6][j];
    if constexpr (kAccelerates) {
      m.half = terms[7][j], m.time = terms[8][j];
      m.ax = terms[9][j], m.av = terms[10][j], m.aa = terms[11][j];
    }
    move_one<kAccelerates>(m, noise, j, s);
  }
}

/// Copies `count` elements of each array between the caller's memory and the block's.
template <bool kStore, class T>
GLINT_INLINE void transfer(T* array, std::size_t first, std::uint32_t count, T* block) {
  if (!array) return;
  T* const from = kStore ? block : array + first;
  T* const to = kStore ? array + first : block;
  if (count == kBlock) {
    __builtin_memcpy(to, from, sizeof(T) * kBlock);
  } else {
    __builtin_memcpy(to, from, sizeof(T) * count);
  }
}

template <bool kStore>
GLINT_INLINE void transfer(const Arrays& a, std::size_t first, std::uint32_t count, State& s) {
  transfer<kStore>(a.x, first, count, s.x);
  transfer<kStore>(a.y, first, count, s.y);
  transfer<kStore>(a.vx, first, count, s.vx);
  transfer<kStore>(a.vy, first, count, s.vy);
  transfer<kStore>(a.intensity, first, count, s.intensity);
  transfer<kStore>(a.ax, first, count, s.ax);
  transfer<kStore>(a.ay, first, count, s.ay);
  transfer<kStore>(a.mode, first, count, s.mode);
}

template <bool kAccelerates, bool kSwitches>
void move_block(const Step& step, std::size_t first, std::uint32_t count, State& s) {
  const auto item = static_cast<std::uint32_t>(first);
  Noise noise;
  transfer<false>(step.arrays, first, count, s);
  draw_motion(step.key, item, noise);
  if (kAccelerates) draw_acceleration(step.key, item, noise);
  draw_intensity(step.key, item, noise);
  if (step.arrays.noise_scale) {
    scale_noise(step.arrays.noise_scale + first, count, kAccelerates, noise);
  }
  if constexpr (kSwitches) {
    switch_modes(step, item, s);
    move_by_mode<kAccelerates>(step, noise, s);
  } else {
    move_all<kAccelerates>(step.transition.move[0], noise, s);
  }
  walk_intensity(step, noise, s);
  transfer<true>(step.arrays, first, count, s);
}

template <bool kAccelerates, bool kSwitches>
void move_blocks(const Step& step, std::size_t begin, std::size_t end) {
  State state{};
  for (std::size_t first = begin; first < end; first += kBlock) {
    const std::size_t left = end - first;
    const std::uint32_t count = left < kBlock ? static_cast<std::uint32_t>(left) : kBlock;
    move_block<kAccelerates, kSwitches>(step, first, count, state);
  }
}

void move(const Step& step, std::size_t begin, std::size_t end) {
  const bool accelerates = step.transition.accelerates, switches = step.transition.modes > 1;
  if (accelerates) {
    switches ? move_blocks<true, true>(step, begin, end)
             : move_blocks<true, false>(step, begin, end);
  } else {
    switches ? move_blocks<false, true>(step, begin, end)
             : move_blocks<false, false>(step, begin, end);
  }
}

}  // namespace

extern const PropagateLanes propagate_lanes;
const PropagateLanes propagate_lanes = {&move};

}  // namespace glint::GLINT_LANES

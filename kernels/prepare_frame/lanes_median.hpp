// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/kernels/core/math.hpp"
#include "glint/kernels/prepare_frame/lanes.hpp"

// Part of lanes.cpp: medians over stacks and lattices.
namespace glint::GLINT_LANES {
namespace {

/// Pixels that go through the network together: 256 bytes of each input.
template <class T>
inline constexpr int kMedianBlock = 256 / static_cast<int>(sizeof(T));

template <class T>
struct Samples {
  alignas(64) T value[kMaxStack][kMedianBlock<T>];
};

template <class T>
GLINT_INLINE void exchange(const MedianNetwork::Step& step, Samples<T>& samples) {
  T* __restrict low = samples.value[step.low];
  T* __restrict high = samples.value[step.high];
  if (step.keep_low && step.keep_high) {
    for (int k = 0; k < kMedianBlock<T>; ++k) {
      const T a = low[k], b = high[k];
      low[k] = a < b ? a : b;
      high[k] = a < b ? b : a;
    }
  } else if (step.keep_low) {
    for (int k = 0; k < kMedianBlock<T>; ++k) low[k] = low[k] < high[k] ? low[k] : high[k];
  } else {
    for (int k = 0; k < kMedianBlock<T>; ++k) high[k] = low[k] < high[k] ? high[k] : low[k];
  }
}

/// Leaves NaNs out: median of n values at a stride; NaN of nothing. Reorders them.
[[gnu::noinline]] float median_of_known(float* value, int n) {
  int known = 0;
  for (int i = 0; i < n; ++i) {
    const float v = value[i];
    if (!(v == v)) continue;
    int k = known++;
    for (; k > 0 && value[k - 1] > v; --k) value[k] = value[k - 1];
    value[k] = v;
  }
  if (known == 0) return __builtin_nanf("");
  return (value[(known - 1) / 2] + value[known / 2]) * 0.5f;
}

/// Medians of a block of n pixels.
template <class T>
GLINT_INLINE void median_block(const MedianNetwork& network, Samples<T>& samples, float* median,
                               int n) {
  for (int s = 0; s < network.count; ++s) exchange(network.steps[s], samples);
  const T* lower = samples.value[network.lower];
  const T* upper = samples.value[network.upper];
  for (int k = 0; k < n; ++k) {
    median[k] = (static_cast<float>(lower[k]) + static_cast<float>(upper[k])) * 0.5f;
  }
}

/// Which pixels of a block have a NaN among their samples; false if none has.
GLINT_INLINE bool find_unknown(const Samples<float>& samples, int inputs, std::int32_t* unknown) {
  for (int k = 0; k < kMedianBlock<float>; ++k) unknown[k] = 0;
  for (int i = 0; i < inputs; ++i) {
    const float* value = samples.value[i];
    for (int k = 0; k < kMedianBlock<float>; ++k) unknown[k] |= value[k] == value[k] ? 0 : 1;
  }
  std::int32_t any = 0;
  for (int k = 0; k < kMedianBlock<float>; ++k) any |= unknown[k];
  return any != 0;
}

/// As median_block, with NaNs left out: those pixels are done again one by one.
GLINT_INLINE void known_median_block(const MedianNetwork& network, Samples<float>& samples,
                                     float* median, int n) {
  constexpr int kBlock = kMedianBlock<float>;
  alignas(64) std::int32_t unknown[kBlock];
  float again[kBlock];
  const bool any = find_unknown(samples, network.inputs, unknown);
  for (int k = 0; any && k < n; ++k) {
    if (unknown[k] == 0) continue;
    float value[kMaxStack];
    for (int i = 0; i < network.inputs; ++i) value[i] = samples.value[i][k];
    again[k] = median_of_known(value, network.inputs);
  }
  median_block(network, samples, median, n);
  for (int k = 0; any && k < n; ++k) {
    if (unknown[k] != 0) median[k] = again[k];
  }
}

template <class T>
void stack_rows(const StackPass<T>& pass, int y0, int y1) {
  constexpr int kBlock = kMedianBlock<T>;
  Samples<T> samples;
  const MedianNetwork& network = *pass.network;
  __builtin_memset(&samples, 0, sizeof(T) * kBlock * static_cast<std::size_t>(network.inputs));
  for (int y = y0; y < y1; ++y) {
    for (int x = 0; x < pass.width; x += kBlock) {
      const int n = pass.width - x < kBlock ? pass.width - x : kBlock;
      for (int i = 0; i < network.inputs; ++i) {
        const T* from = pass.images[i] + y * pass.pitches[i] + x;
        if (n == kBlock) {
          __builtin_memcpy(samples.value[i], from, sizeof(T) * kBlock);
        } else {
          __builtin_memcpy(samples.value[i], from, sizeof(T) * static_cast<std::size_t>(n));
        }
      }
      float* median = pass.median + y * pass.median_pitch + x;
      if constexpr (T(0.5f) != T(0)) {
        known_median_block(network, samples, median, n);
      } else {
        median_block(network, samples, median, n);
      }
    }
  }
}

GLINT_INLINE int clamped(int i, int size) { return i < 0 ? 0 : i >= size ? size - 1 : i; }

void lattice_rows(const LatticePass& pass, int y0, int y1) {
  constexpr int kBlock = kMedianBlock<float>;
  Samples<float> samples;
  for (int y = y0; y < y1; ++y) {
    for (int x = 0; x < pass.width; x += kBlock) {
      const int n = pass.width - x < kBlock ? pass.width - x : kBlock;
      for (int i = 0; i < 25; ++i) {
        const int v = clamped(y + (i / 5 - 2) * pass.spacing, pass.height);
        const int u = x + (i % 5 - 2) * pass.spacing;
        const float* row = pass.image + v * pass.pitch;
        if (u >= 0 && u + kBlock <= pass.width) {
          __builtin_memcpy(samples.value[i], row + u, sizeof(float) * kBlock);
        } else {
          for (int k = 0; k < kBlock; ++k) samples.value[i][k] = row[clamped(u + k, pass.width)];
        }
      }
      known_median_block(*pass.network, samples, pass.median + y * pass.median_pitch + x, n);
    }
  }
}

/// Floats as integers of the same order.
KeyRange make_keys(const float* __restrict values, std::int32_t* __restrict keys, int n) {
  KeyRange range{INT32_MAX, INT32_MIN};
  for (int i = 0; i < n; ++i) {
    const std::int32_t bits = math::bits(values[i]);
    const std::int32_t key = bits ^ ((bits >> 31) & 0x7fffffff);
    range.least = key < range.least ? key : range.least;
    range.most = key > range.most ? key : range.most;
    keys[i] = key;
  }
  return range;
}

int count_up_to(const std::int32_t* keys, int n, std::int32_t pivot) {
  int count = 0;
  for (int i = 0; i < n; ++i) count += keys[i] <= pivot ? 1 : 0;
  return count;
}

}  // namespace
}  // namespace glint::GLINT_LANES

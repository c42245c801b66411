// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/kernels/core/math.hpp"
#include "glint/kernels/core/vectors.hpp"
#include "glint/kernels/prepare_frame/lanes.hpp"

// Part of lanes.cpp: raw pixels to grey.
namespace glint::GLINT_LANES {
namespace {

constexpr int kGreyBlock = 256;

/// A block of grey values, as delivered.
template <class T>
GLINT_INLINE void grey_block(const T* __restrict raw, int channels, float* __restrict grey, int n) {
  if (channels == 1) {
    for (int i = 0; i < n; ++i) grey[i] = static_cast<float>(raw[i]);
  } else if (channels == 3) {
    for (int i = 0; i < n; ++i) {  // P-HPMHT (1)
      grey[i] = math::fma(.2989f, static_cast<float>(raw[3 * i + 2]),
                          math::fma(.587f, static_cast<float>(raw[3 * i + 1]),
                                    .114f * static_cast<float>(raw[3 * i])));
    }
  } else {
    for (int i = 0; i < n; ++i) {
      grey[i] = math::fma(.2989f, static_cast<float>(raw[4 * i + 2]),
                          math::fma(.587f, static_cast<float>(raw[4 * i + 1]),
                                    .114f * static_cast<float>(raw[4 * i])));
    }
  }
}

GLINT_INLINE void put_block(const float* from, float* to, int n, bool past_caches) {
  if (past_caches && n == kGreyBlock) {
    for (int i = 0; i < kGreyBlock; i += kLanes) stream(to + i, load<kLanes>(from + i));
  } else {
    __builtin_memcpy(to, from, sizeof(float) * static_cast<std::size_t>(n));
  }
}

template <class T>
bool grey_rows(const GreyPass<T>& pass, int y0, int y1) {
  alignas(64) float block[kGreyBlock];
  int masked = 0;
  for (int y = y0; y < y1; ++y) {
    const T* raw = pass.raw + y * pass.raw_pitch;
    float* grey = pass.grey + y * pass.grey_pitch;
    for (int x = 0; x < pass.width; x += kGreyBlock) {
      const int n = pass.width - x < kGreyBlock ? pass.width - x : kGreyBlock;
      grey_block(raw + static_cast<std::ptrdiff_t>(x) * pass.channels, pass.channels, block, n);
      if constexpr (T(0.5f) != T(0)) {  // only floats can be bad
        for (int i = 0; i < n; ++i) {
          const bool good = block[i] <= pass.largest && block[i] >= -pass.largest;
          masked |= good ? 0 : 1;
          block[i] = good ? block[i] : __builtin_nanf("");
        }
      }
      if (pass.reciprocal) {
        for (int i = 0; i < n; ++i) {  // P-HPMHT (2); a NaN stays one
          block[i] = 255 / (block[i] < pass.floor ? pass.floor : block[i]);
        }
      }
      put_block(block, grey + x, n, pass.stream);
    }
  }
  if (pass.stream) fence();
  return masked != 0;
}

}  // namespace
}  // namespace glint::GLINT_LANES

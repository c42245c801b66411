// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "glint/kernels/core/inline.hpp"

/// Branch-free scalar float mathematics that compilers turn into vectors. Explicit fma and no
/// reciprocal estimates: the same bits on every instruction set, with every compiler.
namespace glint::math {

GLINT_INLINE float fma(float a, float b, float c) { return __builtin_fmaf(a, b, c); }
GLINT_INLINE std::int32_t bits(float x) { return __builtin_bit_cast(std::int32_t, x); }
GLINT_INLINE float from_bits(std::int32_t i) { return __builtin_bit_cast(float, i); }
GLINT_INLINE float sqrt(float x) { return __builtin_sqrtf(x); }
GLINT_INLINE float clamp(float x, float low, float high) {
  x = x < low ? low : x;
  return x > high ? high : x;
}

#include "glint/kernels/core/math.glsl"

}  // namespace glint::math

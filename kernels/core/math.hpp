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
GLINT_INLINE float clamp(float x, float low, float high) {
  x = x < low ? low : x;
  return x > high ? high : x;
}

/// Adding this rounds |x| < 2^22 to the nearest integer (ties to even) in the low mantissa bits.
inline constexpr float kRound = 12582912.0f;  // 1.5 * 2^23

/// e^x, error <= 1.06 ulp (every float tried); 0 below -87, e^88 above 88.
GLINT_INLINE float exp(float x) {
  const float bounded = clamp(x, -87.0f, 88.0f);
  const float shifted = fma(bounded, 1.44269504f, kRound);
  const float n = shifted - kRound;
  float r = fma(n, -0.693359375f, bounded);  // ln 2 in two parts
  r = fma(n, 2.12194440e-4f, r);
  float p = 1.383682201e-03f;
  p = fma(p, r, 8.374822004e-03f);
  p = fma(p, r, 4.166822633e-02f);
  p = fma(p, r, 1.666642010e-01f);
  p = fma(p, r, 4.999999207e-01f);
  p = fma(p, r, 1.0f);
  p = fma(p, r, 1.0f);
  const auto scaled =
      static_cast<std::uint32_t>(bits(p)) + (static_cast<std::uint32_t>(bits(shifted)) << 23);
  const float y = from_bits(static_cast<std::int32_t>(scaled));
  return x < -87.0f ? 0.0f : y;
}

/// ln(a) for normal a > 0, error <= .87 ulp (every float tried).
GLINT_INLINE float log(float a) {
  const std::int32_t e = (bits(a) - 0x3f2aaaab) & static_cast<std::int32_t>(0xff800000u);
  const float m = from_bits(bits(a) - e);
  const float exponent = static_cast<float>(e) * 1.19209290e-7f;
  const float f = m - 1.0f, s = f * f;
  float r = -0.130310059f, t = 0.140869141f;
  r = fma(r, s, -0.121489584f);
  t = fma(t, s, 0.139814854f);
  r = fma(r, s, -0.166846126f);
  t = fma(t, s, 0.200120345f);
  r = fma(r, s, -0.249996200f);
  r = fma(t, f, r);
  r = fma(r, f, 0.333331972f);
  r = fma(r, f, -0.5f);
  r = fma(r, s, f);
  return fma(exponent, 0.693147182f, r);
}

struct SinCos {
  float sin, cos;
};

/// Sine and cosine of 2 pi u [turns] for |u| < 2^20, error <= 1.2e-7.
GLINT_INLINE SinCos sincos_turns(float u) {
  const float quarters = u * 4.0f;
  const float shifted = quarters + kRound;
  const float r = quarters - (shifted - kRound);
  const std::int32_t k = bits(shifted);
  const float z = r * r;
  float s = 1.579845205e-04f;
  s = fma(s, z, -4.681141485e-03f);
  s = fma(s, z, 7.969255933e-02f);
  s = fma(s, z, -6.459640945e-01f);
  s = fma(s, z, 1.570796327f);
  s *= r;
  float c = 9.036316951e-04f;
  c = fma(c, z, -2.086007131e-02f);
  c = fma(c, z, 2.536692039e-01f);
  c = fma(c, z, -1.233700541f);
  c = fma(c, z, 1.0f);
  const bool swap = (k & 1) != 0;
  const float a = swap ? c : s, b = swap ? s : c;
  const auto sign_a = (static_cast<std::uint32_t>(k) & 2u) << 30;
  const auto sign_b = (static_cast<std::uint32_t>(k + 1) & 2u) << 30;
  return {from_bits(bits(a) ^ static_cast<std::int32_t>(sign_a)),
          from_bits(bits(b) ^ static_cast<std::int32_t>(sign_b))};
}

/// erf(x), absolute error <= 4e-7; +-1 beyond |x| = 4.
GLINT_INLINE float erf(float x) {
  x = clamp(x, -4.0f, 4.0f);
  const float z = x * x;
  float p = -2.72614225801306e-10f;
  p = fma(p, z, 2.77068142495902e-08f);
  p = fma(p, z, -2.10102402082508e-06f);
  p = fma(p, z, -5.69250639462346e-05f);
  p = fma(p, z, -7.34990630326855e-04f);
  p = fma(p, z, -2.95459980854025e-03f);
  p = fma(p, z, -1.60960333262415e-02f);
  p *= x;
  float q = -1.45660718464996e-05f;
  q = fma(q, z, -2.13374055278905e-04f);
  q = fma(q, z, -1.68282697438203e-03f);
  q = fma(q, z, -7.37332916720468e-03f);
  q = fma(q, z, -1.42647390514189e-02f);
  return p / q;
}

}  // namespace glint::math

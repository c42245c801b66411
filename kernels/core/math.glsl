// SPDX-License-Identifier: Apache-2.0
// C++ and GLSL: branch-free float mathematics. C++ reads it inside glint::math, after the functions
// on bits and fma; GLSL after glsl.glsl, which has its own.

// Adding this rounds |x| < 2^22 to the nearest integer (ties to even) in the low mantissa bits.
const float kRound = 12582912.0f;  // 1.5 * 2^23

// e^x, error <= 1.06 ulp (every float tried); 0 below -87, e^88 above 88.
GLINT_INLINE float exp(float x) {
  GLINT_PRECISE const float bounded = clamp(x, -87.0f, 88.0f);
  GLINT_PRECISE const float shifted = fma(bounded, 1.44269504f, kRound);
  GLINT_PRECISE const float n = shifted - kRound;
  GLINT_PRECISE float r = fma(n, -0.693359375f, bounded);  // ln 2 in two parts
  r = fma(n, 2.12194440e-4f, r);
  GLINT_PRECISE float p = 1.383682201e-03f;
  p = fma(p, r, 8.374822004e-03f);
  p = fma(p, r, 4.166822633e-02f);
  p = fma(p, r, 1.666642010e-01f);
  p = fma(p, r, 4.999999207e-01f);
  p = fma(p, r, 1.0f);
  p = fma(p, r, 1.0f);
  const uint scaled = uint(bits(p)) + (uint(bits(shifted)) << 23);
  const float y = from_bits(int(scaled));
  return x < -87.0f ? 0.0f : y;
}

// ln(a) for normal a > 0, error <= .87 ulp (every float tried).
GLINT_INLINE float log(float a) {
  const int e = (bits(a) - 0x3f2aaaab) & int(0xff800000u);
  GLINT_PRECISE const float m = from_bits(bits(a) - e);
  GLINT_PRECISE const float exponent = float(e) * 1.19209290e-7f;
  GLINT_PRECISE const float f = m - 1.0f, s = f * f;
  GLINT_PRECISE float r = -0.130310059f, t = 0.140869141f;
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

// Sine and cosine of 2 pi u [turns] for |u| < 2^20, error <= 1.2e-7.
GLINT_INLINE SinCos sincos_turns(float u) {
  GLINT_PRECISE const float quarters = u * 4.0f;
  GLINT_PRECISE const float shifted = quarters + kRound;
  GLINT_PRECISE const float r = quarters - (shifted - kRound);
  const int k = bits(shifted);
  GLINT_PRECISE const float z = r * r;
  GLINT_PRECISE float s = 1.579845205e-04f;
  s = fma(s, z, -4.681141485e-03f);
  s = fma(s, z, 7.969255933e-02f);
  s = fma(s, z, -6.459640945e-01f);
  s = fma(s, z, 1.570796327f);
  s *= r;
  GLINT_PRECISE float c = 9.036316951e-04f;
  c = fma(c, z, -2.086007131e-02f);
  c = fma(c, z, 2.536692039e-01f);
  c = fma(c, z, -1.233700541f);
  c = fma(c, z, 1.0f);
  const bool swap = (k & 1) != 0;
  GLINT_PRECISE const float a = swap ? c : s, b = swap ? s : c;
  const uint sign_a = (uint(k) & 2u) << 30;
  const uint sign_b = (uint(k + 1) & 2u) << 30;
  SinCos result;
  result.sin = from_bits(bits(a) ^ int(sign_a));
  result.cos = from_bits(bits(b) ^ int(sign_b));
  return result;
}

// erf(x), absolute error <= 4e-7; +-1 beyond |x| = 4.
GLINT_INLINE float erf(float x) {
  x = clamp(x, -4.0f, 4.0f);
  GLINT_PRECISE const float z = x * x;
  GLINT_PRECISE float p = -2.72614225801306e-10f;
  p = fma(p, z, 2.77068142495902e-08f);
  p = fma(p, z, -2.10102402082508e-06f);
  p = fma(p, z, -5.69250639462346e-05f);
  p = fma(p, z, -7.34990630326855e-04f);
  p = fma(p, z, -2.95459980854025e-03f);
  p = fma(p, z, -1.60960333262415e-02f);
  p *= x;
  GLINT_PRECISE float q = -1.45660718464996e-05f;
  q = fma(q, z, -2.13374055278905e-04f);
  q = fma(q, z, -1.68282697438203e-03f);
  q = fma(q, z, -7.37332916720468e-03f);
  q = fma(q, z, -1.42647390514189e-02f);
  return p / q;
}

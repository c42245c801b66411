// SPDX-License-Identifier: Apache-2.0
// C++ and GLSL.

// Log ratios are exact up to here (a peak SNR of about 15 dB); above they grow only like a
// logarithm.
const float kExactLogRatio = 20.0f;
// Sums of e^80 times any mass in a window still fit a float.
const float kMaxLogRatio = 80.0f;

// The log ratio that weights are made of: r up to kExactLogRatio = k, then k + k ln(r / k), at most
// kMaxLogRatio. Bright targets are seldom the shape that the model says (clipped, extended,
// blurred): the bound keeps the order of their particles without letting one of them take all the
// weight, and without the plateau that a hard clamp makes.
GLINT_INLINE float bounded_log_ratio(float r) {
  const float above = r > kExactLogRatio ? r * (1.0f / kExactLogRatio) : 1.0f;
  const float grown = GLINT_MATH(fma)(kExactLogRatio, GLINT_MATH(log)(above), kExactLogRatio);
  const float bounded = r > kExactLogRatio ? grown : r;
  return bounded < kMaxLogRatio ? bounded : kMaxLogRatio;
}

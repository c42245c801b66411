// SPDX-License-Identifier: Apache-2.0
// What the files for C++ and GLSL read where GLSL differs. The builtin functions that drivers round
// as they like get out of the way of math.glsl's.
#define GLINT_INLINE
#define GLINT_PRECISE precise
#define GLINT_MATH(name) name
#define fma glint_fma
#define exp glint_exp
#define log glint_log

// Fused, as on the processor, whatever the driver's own does: the product of two floats is exact in
// double. (Rounded twice, which shows in one of 2^29 results.)
float fma(float a, float b, float c) {
  precise double sum = double(a) * double(b) + double(c);
  return float(sum);
}
int bits(float x) { return floatBitsToInt(x); }
float from_bits(int x) { return intBitsToFloat(x); }

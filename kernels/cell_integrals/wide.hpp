// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/kernels/core/vectors.hpp"

/// Sixteen floats on any instruction set. Include in lanes.cpp only.
namespace glint::GLINT_LANES {

using Part = Floats<kLanes>;
inline constexpr int kParts = 16 / kLanes;

struct Wide {
  Part part[kParts];
};

GLINT_INLINE Wide wide(float x) {
  Wide w;
  for (int k = 0; k < kParts; ++k) w.part[k] = broadcast<Part>(x);
  return w;
}
GLINT_INLINE Wide zero() { return wide(0.0f); }
GLINT_INLINE Wide load_wide(const float* p) {
  Wide w;
  for (int k = 0; k < kParts; ++k) w.part[k] = load<kLanes>(p + k * kLanes);
  return w;
}
/// The first `n` < 16, then zeros; reads nothing beyond them.
GLINT_INLINE Wide load_wide_first(const float* p, int n) {
  Wide w = zero();
  for (int k = 0; k < kParts; ++k) {
    const int left = n - k * kLanes;
    if (left > 0) w.part[k] = load_first<kLanes>(p + k * kLanes, left < kLanes ? left : kLanes);
  }
  return w;
}
GLINT_INLINE void store_wide(float* p, const Wide& w) {
  for (int k = 0; k < kParts; ++k) store(p + k * kLanes, w.part[k]);
}
GLINT_INLINE Wide operator+(const Wide& a, const Wide& b) {
  Wide w;
  for (int k = 0; k < kParts; ++k) w.part[k] = a.part[k] + b.part[k];
  return w;
}
GLINT_INLINE Wide operator*(const Wide& a, const Wide& b) {
  Wide w;
  for (int k = 0; k < kParts; ++k) w.part[k] = a.part[k] * b.part[k];
  return w;
}
GLINT_INLINE Wide operator/(const Wide& a, const Wide& b) {
  Wide w;
  for (int k = 0; k < kParts; ++k) w.part[k] = a.part[k] / b.part[k];
  return w;
}
GLINT_INLINE Wide multiply_add(const Wide& a, const Wide& b, const Wide& c) {
  Wide w;
  for (int k = 0; k < kParts; ++k) w.part[k] = fma(a.part[k], b.part[k], c.part[k]);
  return w;
}
/// Elements 1 ... 16 of a and b in a row.
GLINT_INLINE Wide one_on(const Wide& a, const Wide& b = zero()) {
  Wide w;
  for (int k = 0; k < kParts; ++k) {
    w.part[k] = window<1>(a.part[k], k + 1 < kParts ? a.part[(k + 1) % kParts] : b.part[0]);
  }
  return w;
}

GLINT_INLINE Part bounded(Part x, Part low, Part high) { return lesser(greater(x, low), high); }

/// Sum in one order on every instruction set: halves on halves.
GLINT_INLINE float total(const Wide& w) {
#ifdef __AVX512F__
  const Floats<16> v = w.part[0];
  const Floats<8> h = __builtin_shufflevector(v, v, 0, 1, 2, 3, 4, 5, 6, 7) +
                      __builtin_shufflevector(v, v, 8, 9, 10, 11, 12, 13, 14, 15);
#else
  const Floats<8> h = w.part[0] + w.part[1];
#endif
  const Floats<4> q =
      __builtin_shufflevector(h, h, 0, 1, 2, 3) + __builtin_shufflevector(h, h, 4, 5, 6, 7);
  return (q[0] + q[2]) + (q[1] + q[3]);
}

}  // namespace glint::GLINT_LANES

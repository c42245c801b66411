// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/kernels/core/vectors.hpp"

namespace glint::GLINT_LANES::particle_likelihood {

GLINT_INLINE Floats<8> low_pairs(Floats<8> a, Floats<8> b) {
  return __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13);
}
GLINT_INLINE Floats<8> high_pairs(Floats<8> a, Floats<8> b) {
  return __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15);
}
GLINT_INLINE Floats<8> low_quads(Floats<8> a, Floats<8> b) {
  return __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13);
}
GLINT_INLINE Floats<8> high_quads(Floats<8> a, Floats<8> b) {
  return __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
}
GLINT_INLINE Floats<8> low_halves(Floats<8> a, Floats<8> b) {
  return __builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11);
}
GLINT_INLINE Floats<8> high_halves(Floats<8> a, Floats<8> b) {
  return __builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15);
}

/// Rows become columns.
GLINT_INLINE void transpose(Floats<8>* r) {
  Floats<8> pairs[8], quads[8];
#pragma GCC unroll 4
  for (int k = 0; k < 4; ++k) {
    pairs[k] = low_pairs(r[2 * k], r[2 * k + 1]);
    pairs[k + 4] = high_pairs(r[2 * k], r[2 * k + 1]);
  }
#pragma GCC unroll 2
  for (int k = 0; k < 8; k += 4) {
    quads[k] = low_quads(pairs[k], pairs[k + 1]);
    quads[k + 1] = high_quads(pairs[k], pairs[k + 1]);
    quads[k + 2] = low_quads(pairs[k + 2], pairs[k + 3]);
    quads[k + 3] = high_quads(pairs[k + 2], pairs[k + 3]);
  }
#pragma GCC unroll 2
  for (int k = 0; k < 2; ++k) {
    r[k] = low_halves(quads[k], quads[k + 2]);
    r[k + 2] = low_halves(quads[k + 4], quads[k + 6]);
    r[k + 4] = high_halves(quads[k], quads[k + 2]);
    r[k + 6] = high_halves(quads[k + 4], quads[k + 6]);
  }
}

}  // namespace glint::GLINT_LANES::particle_likelihood

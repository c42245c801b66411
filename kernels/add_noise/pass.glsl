// SPDX-License-Identifier: Apache-2.0
// C++ and GLSL: pixels in a row.
struct NoisePass {
  KeyWords key;
  uint first;  // number of the first pixel sent
  uint count;  // how many are
  float sigma;
};

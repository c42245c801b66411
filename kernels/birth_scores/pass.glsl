// SPDX-License-Identifier: Apache-2.0
// C++ and GLSL: a band of rows.
struct ScorePass {
  int width, rows, top;  // top: the first row's number
  uint boxes;
  float intensity, energy, intensity_low, intensity_high, low, high;
};
struct MaskBox {  // Box
  int x0, y0, x1, y1;
};

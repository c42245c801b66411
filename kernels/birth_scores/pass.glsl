// SPDX-License-Identifier: Apache-2.0
// C++ and GLSL: pixels in a row, whatever the shape of the map.
struct ScorePass {
  int count;
  float intensity, energy, intensity_low, intensity_high, low, high;
};

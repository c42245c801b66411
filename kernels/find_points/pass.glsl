// SPDX-License-Identifier: Apache-2.0
// C++ and GLSL: one band of a map's rows as the device sees it.
struct PointBand {
  int width, height;  // of the map
  int top;            // row of the map that is the first one sent
  int first, last;    // rows whose points are found
  int radius;
  uint units;  // whether 5x5 units
  float threshold;
};
const int kSpan = 64;  // pixels or units whose points one invocation finds
const int kUnit = 5;   // side of a unit [px]

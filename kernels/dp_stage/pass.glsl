// SPDX-License-Identifier: Apache-2.0
// C++ and GLSL: one band of a frame's rows as the device sees it.
struct StageBand {
  int width, height;  // of the frame
  int top;            // row of the frame that is the first one sent
  int first, last;    // rows that are made
  int reach, tolerance;
  uint follows;  // whether moves bind
};

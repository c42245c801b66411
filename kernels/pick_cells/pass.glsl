// SPDX-License-Identifier: Apache-2.0
// C++ and GLSL: cells whose windows lie in a band of the score's rows.
struct PickPass {
  int width, height;      // of the score
  int top, first, last;   // row that is the first one sent; rows whose cells are picked for
  int reach;
  uint count;
};

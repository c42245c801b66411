// SPDX-License-Identifier: Apache-2.0
// C++ and GLSL: particles over a band of a frame's rows as the device sees them.
struct ParticleBand {
  KeyWords key;
  int width, height;        // of the frame
  int top;                  // row of the frame that is the first one sent
  int row_first, row_last;  // rows whose particles get their ratio
  int half_width;
  uint first, count;  // number of the first particle sent, and how many are
  float jitter;
  // WeightPolynomials
  int terms;
  float even[64], odd[64];  // [8 k + d]
  float scale;
};

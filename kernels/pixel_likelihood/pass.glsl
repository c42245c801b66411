// SPDX-License-Identifier: Apache-2.0
// C++ and GLSL: one band of a frame's rows as the device sees it.
struct PixelBand {
  int width, height;  // of the frame
  int top;            // row of the frame that is the first one sent
  int first, last;    // rows of the map that are made
  int half_width;
  uint uint16;  // whether pixels are words of 16 bits, two in each uint
  float offset, gain, threshold;
  float energy_gain;  // -I^2 / 2
  float relative[8];  // weight k pixels from the centre over the centre's
  float squared[8];   // weight k pixels from the centre, squared
};
const int kSpan = 64;  // pixels whose hits one invocation finds

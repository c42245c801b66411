// SPDX-License-Identifier: Apache-2.0
// C++ and GLSL: bands of a frame's rows as the device sees them. `top` is the row of the frame that
// is the first one sent, [first, last) are the rows that are made.
struct GreyBand {
  uint pixels;
  uint channels, bytes;  // of a pixel; of a channel, 4 for floats
  uint reciprocal;
  float reciprocal_floor, largest;
};
struct MedianBand {
  int width, height, top, first, last;
  int spacing;         // of the lattice
  uint images, bytes;  // of the stack; of a pixel, 4 for floats
};
struct HalfBand {
  int width, half_width;
  uint pixels;  // that are made
};
// The rows first, first + step, ... of a frame beside one that is moved by (ix + ax, iy + ay).
struct MovedBand {
  int width, height, top, moving_top;
  int first, rows, step;
  int ix, iy;
  float ax, ay;
};
struct DifferenceSum {
  double sum;
  uint count, unused;
};
struct EquationSum {
  double xx, xy, yy, xe, ye;
};
struct StructureBand {
  int width, height, top, first, last;
  float share;
};
// Pixels of every step-th row, from the `first` that was sent, and column.
struct ResidualBand {
  uint width, first, step, columns, rows;
  uint less;  // whether there is a background to take off
};
struct SpreadPass {
  int count;
};
struct WhitenBand {
  int width, height, top, bottom, first, last;
  int outer, inner;
  float sigma, inverse_sigma, energy_scale, energy_cap;
  int keep_bits, flip_bits;
  float offset, clip_low, clip_high;
  uint structured;
  int noise_step;  // 0 for no noise map
};
struct Ring {          // about a pixel, along its row
  uint outer, inner;   // sums of energies
  uint known;          // pixels with an energy: of the outer box, and 2^16 times of the inner
};
const int kColumns = 64;  // of a row that one invocation sums up

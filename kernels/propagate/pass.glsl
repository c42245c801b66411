// SPDX-License-Identifier: Apache-2.0
// C++ and GLSL: one step of a set of particles as the device sees it.
struct MoveTerms {  // Move<float>
  float along, across, cosine, sine, xx, vx, vv;
  float half_square, time, ax, av, aa;
};
struct DeviceStep {
  KeyWords key, switch_key;
  uint first, count;  // number of the first particle sent, and how many are
  uint modes, accelerates, scaled;
  float intensity_deviation, intensity_low, intensity_high;
  MoveTerms move[8];
  float cumulative[64];  // [8 from + to]: probability of a new mode <= to
};

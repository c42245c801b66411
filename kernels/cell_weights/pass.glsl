// SPDX-License-Identifier: Apache-2.0
// C++ and GLSL: what the passes need to know.
struct CellPass {
  int width, height, half_width;
  float clutter;
  uint count;   // of what the pass runs over: particles, runs
  uint shift;   // of the digit that a pass sorts by
};
const uint kChunk = 256u;  // particles that one invocation sorts
const uint kDigits = 16u;  // of a place in the sort's keys

// SPDX-License-Identifier: Apache-2.0
// C++ and GLSL: what the passes need to know. Doubles travel as two words.
struct DrawPass {
  uint particles, offspring;
  uint splits;  // whether residual
  uint factor[2], offset[2];  // Scale
  uint rate[2], lead[2];      // Points
  uint count[2], total[2], inverse[2], remainder_factor[2];  // Splitter
};
const uint kChunk = 256u;  // particles that one invocation adds up

// SPDX-License-Identifier: Apache-2.0
// C++ and GLSL: which random words a particle takes. Its four normals of position and velocity are
// item `particle` of draw 0. What needs fewer than four words a particle is shared inside fixed
// blocks of 64 particles, so that a vector of items serves whole vectors of particles.
const uint kBlock = 64u;
const uint kIntensityDraw = 1u, kAccelerationDraw = 2u;

struct Share {
  uint item;
  uint part;  // which of the item's parts
};

// Item that serves `particle` if each item's four words serve `parts` particles.
GLINT_INLINE Share share_of(uint particle, uint parts) {
  const uint items = kBlock / parts, lane = particle % kBlock;
  Share share;
  share.item = particle / kBlock * items + lane % items;
  share.part = lane / items;
  return share;
}

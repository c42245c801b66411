// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "glint/kernels/core/inline.hpp"

/// Which random words a particle takes. Its four normals of position and velocity are item
/// `particle` of draw 0. What needs fewer than four words a particle is shared inside fixed blocks
/// of 64 particles, so that a vector of items serves whole vectors of particles.
namespace glint::propagate {

inline constexpr std::uint32_t kBlock = 64;
inline constexpr std::uint32_t kIntensityDraw = 1, kAccelerationDraw = 2;

struct Share {
  std::uint32_t item;
  std::uint32_t part;  ///< which of the item's parts
};

/// Item that serves `particle` if each item's four words serve `parts` particles.
GLINT_INLINE Share share_of(std::uint32_t particle, std::uint32_t parts) {
  const std::uint32_t items = kBlock / parts, lane = particle % kBlock;
  return {particle / kBlock * items + lane % items, lane / items};
}

}  // namespace glint::propagate

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/kernels/core/inline.hpp"

/// Where a particle is: in float, the same in the reference and in the lanes, so that both choose
/// the same pixel for a particle on the edge between two.
namespace glint::particle_likelihood {

/// Coordinate seen through the sensor's position error. P-PHD (3).
GLINT_INLINE float jittered(float x, float jitter, float normal) { return x + jitter * normal; }

/// Coordinate counted from the outer edge of pixel 0: the pixel that holds x is its floor.
GLINT_INLINE float from_edge(float x) { return x + 0.5f; }

/// Whether the frame's `size` pixels hold the coordinate; false for a NaN.
GLINT_INLINE bool inside(float edge, int size) {
  return edge >= 0.0f && edge < static_cast<float>(size);
}

}  // namespace glint::particle_likelihood

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/kernels/core/isa.hpp"
#include "glint/kernels/propagate/transition.hpp"

namespace glint {
namespace propagate {

/// Particle arrays as the lanes take them; null where there are none.
struct Arrays {
  float *x, *y, *vx, *vy, *intensity, *ax, *ay;
  std::uint32_t* mode;
  const float* noise_scale;
};

/// One call of the kernel in float.
struct Step {
  Arrays arrays;
  Transition<float> transition;
  float intensity_low, intensity_high;
  RandomKey key, switch_key;
};

}  // namespace propagate

struct PropagateLanes {
  /// Moves the particles [begin, end); begin is a multiple of propagate::kBlock.
  void (*move)(const propagate::Step& step, std::size_t begin, std::size_t end);
};

GLINT_DECLARE_LANES(PropagateLanes, propagate_lanes)

}  // namespace glint

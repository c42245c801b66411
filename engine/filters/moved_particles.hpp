// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>

#include "glint/kernels/core/particles.hpp"
#include "glint/kernels/resample/resample.hpp"

namespace glint {

/// All arrays of `from` but the weight, from particle `first` on, as they move to `to` in
/// resampling, from particle `target` on.
inline std::array<MovedArray, 9> moved_particles(const Particles& from, std::size_t first,
                                                 Particles& to, std::size_t target) {
  return {MovedArray{from.x.data() + first, to.x.data() + target},
          MovedArray{from.y.data() + first, to.y.data() + target},
          MovedArray{from.vx.data() + first, to.vx.data() + target},
          MovedArray{from.vy.data() + first, to.vy.data() + target},
          MovedArray{from.ax.data() + first, to.ax.data() + target},
          MovedArray{from.ay.data() + first, to.ay.data() + target},
          MovedArray{from.intensity.data() + first, to.intensity.data() + target},
          MovedArray{from.mode.data() + first, to.mode.data() + target},
          MovedArray{from.label.data() + first, to.label.data() + target}};
}

}  // namespace glint

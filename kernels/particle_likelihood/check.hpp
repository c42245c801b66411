// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <stdexcept>

#include "glint/kernels/particle_likelihood/particle_likelihood.hpp"

namespace glint::particle_likelihood {

/// Throws std::invalid_argument for spans of unlike length or a window that no kernel takes.
inline void check(const ParticleLikelihood::Args& args) {
  const std::size_t n = args.x.size();
  if (args.y.size() != n || args.intensity.size() != n || args.log_ratio.size() != n) {
    throw std::invalid_argument("x, y, intensity and log_ratio must have one length");
  }
  if (args.spread.half_width < 0 || args.spread.half_width > kMaxHalfWidth ||
      !(args.spread.sigma > 0)) {
    throw std::invalid_argument(
        "the point spread needs sigma > 0 and a half width of 0 to 7 pixels");
  }
}

}  // namespace glint::particle_likelihood

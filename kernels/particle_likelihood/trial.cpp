// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/particle_likelihood/particle_likelihood.hpp"

namespace glint {

std::vector<std::unique_ptr<Trial>> ParticleLikelihood::trials() { return {}; }

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/particle_likelihood/particle_likelihood.hpp"

namespace glint {

void ParticleLikelihood::tbb(const Args& args, Workers&) { serial(args); }

}  // namespace glint

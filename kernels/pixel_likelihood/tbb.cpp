// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/pixel_likelihood/pixel_likelihood.hpp"

namespace glint {

void PixelLikelihood::tbb(const Args& args, Workers&) { serial(args); }

}  // namespace glint

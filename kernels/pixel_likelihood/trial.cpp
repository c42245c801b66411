// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/pixel_likelihood/pixel_likelihood.hpp"

namespace glint {

std::vector<std::unique_ptr<Trial>> PixelLikelihood::trials() { return {}; }

}  // namespace glint

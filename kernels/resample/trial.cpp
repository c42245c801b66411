// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/resample/resample.hpp"

namespace glint {

std::vector<std::unique_ptr<Trial>> Resample::trials() { return {}; }

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/propagate/propagate.hpp"

namespace glint {

std::vector<std::unique_ptr<Trial>> Propagate::trials() { return {}; }

}  // namespace glint

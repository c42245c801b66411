// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/cell_weights/cell_weights.hpp"

namespace glint {

void CellWeights::tbb(const Args& args, Workers&) { serial(args); }

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/propagate/propagate.hpp"

namespace glint {

void Propagate::tbb(const Args& args, Workers&) { serial(args); }

}  // namespace glint

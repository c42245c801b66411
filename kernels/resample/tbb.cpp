// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/resample/resample.hpp"

namespace glint {

void Resample::tbb(const Args& args, Workers&) { serial(args); }

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/core/workers.hpp"

#include <tbb/info.h>

namespace glint {

Workers::Workers(int threads, Isa isa)
    : threads_(threads > 0 ? threads : tbb::info::default_concurrency()),
      isa_(isa),
      arena_(threads_) {}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/kernels/core/isa.hpp"
#include "glint/kernels/core/random.hpp"

namespace glint {

struct AddNoiseLanes {
  /// Adds noise to n pixels, the first of which is number `pixel`.
  void (*row)(float* values, int n, std::uint32_t pixel, float sigma, RandomKey key);
};
GLINT_DECLARE_LANES(AddNoiseLanes, add_noise_lanes)

}  // namespace glint

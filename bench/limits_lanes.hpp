// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "glint/kernels/core/isa.hpp"

namespace glint {

/// The passes of limits.hpp over `n` elements, n a multiple of 64, 64-byte aligned.
struct LimitLanes {
  void (*stream_copy)(const float* from, float* to, int n);
  void (*stream_widen)(const std::uint16_t* from, float* to, int n);
  void (*read)(const float* from, int n);
  void (*scale_in_place)(float* values, int n);
  void (*combine)(const float* a, const float* b, const float* c, float* to, int n);
};
GLINT_DECLARE_LANES(LimitLanes, limit_lanes)

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/kernels/core/inline.hpp"
#include "glint/kernels/core/math.hpp"

namespace glint {
#include "glint/kernels/cell_weights/bound.glsl"
}  // namespace glint

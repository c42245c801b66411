// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/kernels/core/inline.hpp"

namespace glint::propagate {
#include "glint/kernels/propagate/draws.glsl"
}  // namespace glint::propagate

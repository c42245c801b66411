// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

// Every function that a lanes.cpp uses must be inlined there: an out-of-line copy compiled for a
// newer instruction set could be the one that the linker keeps for everybody.
#define GLINT_INLINE [[gnu::always_inline]] inline

// For the .glsl files that C++ and GLSL share: floats that a GLSL compiler must not contract, which
// no C++ compiler does here, and where the mathematics is.
#define GLINT_PRECISE
#define GLINT_MATH(name) math::name
namespace glint {
using uint = std::uint32_t;
}

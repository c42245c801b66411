// SPDX-License-Identifier: Apache-2.0
#pragma once

// Every function that a lanes.cpp uses must be inlined there: an out-of-line copy compiled for a
// newer instruction set could be the one that the linker keeps for everybody.
#define GLINT_INLINE [[gnu::always_inline]] inline

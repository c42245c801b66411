// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>

#include "glint/kernels/core/gl_queue.hpp"

namespace glint::gl {

/// Turns `count` >= 0 counts into the sums of those before them, without waiting for it. Returns
/// where the sum of all will be, as the buffer's first value.
Buffer scan(Queue& queue, const Buffer& counts, std::size_t count);

/// The same; waits for the sum of all.
std::uint32_t sum_before(Queue& queue, const Buffer& counts, std::size_t count);

}  // namespace glint::gl

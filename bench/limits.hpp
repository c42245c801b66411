// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "glint/kernels/core/workers.hpp"

/// The machine's own limits: passes over memory that do nothing else. Kernels are measured against
/// them in the same run.
namespace glint::bench {

void stream_copy(Workers& workers, std::span<const float> from, std::span<float> to);
/// 16-bit pixels to float ones.
void stream_widen(Workers& workers, std::span<const std::uint16_t> from, std::span<float> to);
void read(Workers& workers, std::span<const float> from);
/// Reads and writes every element where it is.
void scale_in_place(Workers& workers, std::span<float> values);
/// Reads three arrays and writes one.
void combine(Workers& workers, std::span<const float> a, std::span<const float> b,
             std::span<const float> c, std::span<float> to);
/// Copy through the caches.
void copy(Workers& workers, std::span<const float> from, std::span<float> to);

}  // namespace glint::bench

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "glint/kernels/core/frame.hpp"

namespace glint {

/// True for images beyond this size that lie on cache lines: they leave nothing in the last cache
/// for a later reader, so they are stored past it.
inline bool worth_streaming(const ImageView<float>& image) {
  constexpr std::int64_t kStreamBytes = std::int64_t{32} << 20;
  return std::int64_t{4} * image.width * image.height > kStreamBytes &&
         reinterpret_cast<std::uintptr_t>(image.data) % 64 == 0 && image.pitch % 16 == 0;
}

}  // namespace glint

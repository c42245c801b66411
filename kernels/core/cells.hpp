// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

namespace glint {

/// Largest side of a frame [px]: its cells, pixels counted row by row from 0, then fit into 32
/// bits.
inline constexpr int kMaxSide = 65535;

/// Cell of a pixel inside the frame.
inline std::uint32_t cell_at(int x, int y, int width) {
  return static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(width) +
         static_cast<std::uint32_t>(x);
}

struct Pixel {
  int x, y;
};

/// Pixel of a cell.
inline Pixel pixel_at(std::uint32_t cell, int width) {
  const auto columns = static_cast<std::uint32_t>(width);
  return {static_cast<int>(cell % columns), static_cast<int>(cell / columns)};
}

}  // namespace glint

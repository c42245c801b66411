// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "glint/kernels/core/frame.hpp"

namespace glint {

/// The pixels inside a list of boxes. A change costs the area of the boxes, not that of the frame.
class PixelMask {
 public:
  /// Replaces the boxes; they are clipped to the frame.
  void set(std::span<const Box> boxes, int width, int height);
  bool empty() const { return boxes_.empty(); }
  std::span<const Box> boxes() const { return boxes_; }  ///< clipped
  /// Whether the pixel that holds (x, y) [px] is in a box. False outside the frame.
  bool covers(float x, float y) const {
    const float left = std::floor(x + 0.5f), top = std::floor(y + 0.5f);
    if (!(left >= 0 && top >= 0 && left < static_cast<float>(width_) &&
          top < static_cast<float>(height_))) {
      return false;
    }
    return covered_[static_cast<std::size_t>(top) * static_cast<std::size_t>(width_) +
                    static_cast<std::size_t>(left)] != 0;
  }

 private:
  void paint(std::uint8_t value);

  int width_ = 0, height_ = 0;
  std::vector<std::uint8_t> covered_;  // row by row
  std::vector<Box> boxes_;
};

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/pixel_mask.hpp"

#include <algorithm>

namespace glint {

void PixelMask::paint(std::uint8_t value) {
  for (const Box& box : boxes_) {
    for (int y = box.y0; y < box.y1; ++y) {
      const auto row = static_cast<std::ptrdiff_t>(y) * width_;
      std::fill(covered_.begin() + row + box.x0, covered_.begin() + row + box.x1, value);
    }
  }
}

void PixelMask::set(std::span<const Box> boxes, int width, int height) {
  if (width != width_ || height != height_) {
    width_ = width, height_ = height;
    covered_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
  } else {
    paint(0);
  }
  boxes_.clear();
  for (const Box& box : boxes) {
    const Box inside{std::max(0, box.x0), std::max(0, box.y0), std::min(width, box.x1),
                     std::min(height, box.y1)};
    if (inside.x0 < inside.x1 && inside.y0 < inside.y1) boxes_.push_back(inside);
  }
  paint(1);
}

}  // namespace glint

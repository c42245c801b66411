// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/core/raw_pixels.hpp"

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace glint {

RawPixels checked(RawPixels pixels) {
  if (pixels.width <= 0 || pixels.height <= 0) {
    throw std::invalid_argument("a frame must have at least one pixel");
  }
  if (pixels.channels != 1 && pixels.channels != 3 && pixels.channels != 4) {
    throw std::invalid_argument("a frame must have 1, 3 or 4 channels, got " +
                                std::to_string(pixels.channels));
  }
  if (std::visit([](const auto* data) { return data == nullptr; }, pixels.data)) {
    throw std::invalid_argument("a frame must have pixels: its data is a null pointer");
  }
  if (pixels.pitch == 0) pixels.pitch = pixels.row();
  if (std::abs(pixels.pitch) < pixels.row()) {
    throw std::invalid_argument(
        "a frame's pitch must be 0 (rows without gaps) or at least a row, " +
        std::to_string(pixels.row()) + " elements, got " + std::to_string(pixels.pitch) +
        ": it counts elements, not bytes");
  }
  return pixels;
}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/source.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <variant>

namespace glint {

void own_pixels(SourceFrame& frame) {
  const RawPixels pixels = checked(frame.pixels);
  std::visit(
      [&]<class T>(const T* data) {
        const std::ptrdiff_t row = pixels.row();
        auto copy = std::make_shared_for_overwrite<T[]>(
            static_cast<std::size_t>(row * std::ptrdiff_t{pixels.height}));
        for (int y = 0; y < pixels.height; ++y) {
          std::copy_n(data + y * pixels.pitch, row, copy.get() + y * row);
        }
        frame.pixels = {static_cast<const T*>(copy.get()), pixels.width, pixels.height,
                        pixels.channels, row};
        frame.owner = std::move(copy);
      },
      pixels.data);
}

}  // namespace glint

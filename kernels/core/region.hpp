// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <span>

#include "glint/kernels/core/frame.hpp"

namespace glint {

/// Rows of bytes in the host's memory: an array, or an image without the padding of its rows.
struct Region {
  const std::byte* data = nullptr;
  std::size_t row_bytes = 0, rows = 0;
  std::ptrdiff_t pitch = 0;  ///< from one row to the next [bytes]

  std::size_t bytes() const { return row_bytes * rows; }
  /// The same bytes as one row, if nothing lies between its rows.
  Region flat() const {
    const bool gapless = rows == 1 || pitch == static_cast<std::ptrdiff_t>(row_bytes);
    return gapless ? Region{data, bytes(), 1, static_cast<std::ptrdiff_t>(bytes())} : *this;
  }
};

template <class T>
Region region_of(std::span<T> values) {
  const std::size_t bytes = values.size_bytes();
  return {reinterpret_cast<const std::byte*>(values.data()), bytes, 1,
          static_cast<std::ptrdiff_t>(bytes)};
}

template <class T>
Region region_of(ImageView<T> image) {
  if (image.empty()) return {};
  return {reinterpret_cast<const std::byte*>(image.data),
          static_cast<std::size_t>(image.width) * sizeof(T), static_cast<std::size_t>(image.height),
          image.pitch * static_cast<std::ptrdiff_t>(sizeof(T))};
}

}  // namespace glint

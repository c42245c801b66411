// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/capi/pushed_frame.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "glint/frontends/capi/guard.hpp"

namespace glint::capi {
namespace {

std::ptrdiff_t bytes_of(glint_pixel pixel) {
  switch (pixel) {
    case GLINT_GRAY8:
      return 1;
    case GLINT_GRAY16:
      return 2;
    case GLINT_FLOAT32:
      return 4;
  }
  throw BadArgument("pixel must be GLINT_GRAY8, GLINT_GRAY16 or GLINT_FLOAT32");
}

template <class T>
decltype(RawPixels::data) as_pixels(const void* data) {
  return static_cast<const T*>(data);
}

decltype(RawPixels::data) as_pixels(const void* data, glint_pixel pixel) {
  if (pixel == GLINT_GRAY8) return as_pixels<std::uint8_t>(data);
  if (pixel == GLINT_GRAY16) return as_pixels<std::uint16_t>(data);
  return as_pixels<float>(data);
}

/// Rows one after the other in aligned memory.
std::shared_ptr<std::byte[]> rows_of(const glint_frame& frame, std::ptrdiff_t row) {
  auto copy = std::make_shared_for_overwrite<std::byte[]>(
      static_cast<std::size_t>(row * std::ptrdiff_t{frame.height}));
  for (std::int32_t y = 0; y < frame.height; ++y) {
    std::memcpy(copy.get() + y * row,
                static_cast<const std::byte*>(frame.data) + y * frame.row_bytes,
                static_cast<std::size_t>(row));
  }
  return copy;
}

}  // namespace

SourceFrame source_frame(glint_frame frame) {
  require(frame.data != nullptr, "frame.data is NULL");
  require(frame.width > 0 && frame.height > 0, "frame.width and frame.height must be above 0");
  require(frame.channels == 1 || frame.channels == 3 || frame.channels == 4,
          "frame.channels must be 1 (grey), 3 (BGR) or 4 (BGRA)");
  const std::ptrdiff_t size = bytes_of(frame.pixel);
  const std::ptrdiff_t row = size * frame.width * frame.channels;
  if (frame.row_bytes == 0) frame.row_bytes = row;
  require(frame.row_bytes >= row, "frame.row_bytes is less than a row of pixels");
  const bool aligned =
      frame.row_bytes % size == 0 &&
      reinterpret_cast<std::uintptr_t>(frame.data) % static_cast<std::uintptr_t>(size) == 0;
  SourceFrame source;
  source.time = frame.time;
  source.pixels = {{}, frame.width, frame.height, frame.channels, row / size};
  if (frame.release != nullptr && aligned) {
    source.pixels.data = as_pixels(frame.data, frame.pixel);
    source.pixels.pitch = frame.row_bytes / size;
    return source;
  }
  std::shared_ptr<std::byte[]> copy = rows_of(frame, row);
  source.pixels.data = as_pixels(copy.get(), frame.pixel);
  source.owner = std::move(copy);
  return source;
}

}  // namespace glint::capi

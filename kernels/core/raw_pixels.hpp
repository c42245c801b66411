// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <variant>

namespace glint {

/// Pixels as a source delivers them: interleaved channels of 8 or 16 bits, or float.
struct RawPixels {
  std::variant<const std::uint8_t*, const std::uint16_t*, const float*> data;
  int width = 0, height = 0, channels = 1;  ///< 1 = grey, 3 = BGR, 4 = BGRA
  /// Elements (not pixels) from one row to the next, negative if the rows go upwards in memory;
  /// 0: rows follow each other without gaps.
  std::ptrdiff_t pitch = 0;

  /// Elements of a row.
  std::ptrdiff_t row() const { return std::ptrdiff_t{width} * channels; }
};

/// The same pixels with the pitch that 0 stands for. Throws std::invalid_argument for pixels
/// without size or data, other than 1, 3 or 4 channels, and a pitch below a row.
RawPixels checked(RawPixels pixels);

}  // namespace glint

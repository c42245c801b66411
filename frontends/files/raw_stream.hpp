// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "glint/engine/scheduler.hpp"

namespace glint {

/// Frames without a header, as they come out of a camera or a pipe: rows from the top, no padding.
struct RawFormat {
  enum class Pixel { gray8, gray16le, grayf32le };
  Pixel pixel = Pixel::gray8;
  int width = 0, height = 0;  ///< [px]
};

/// `pixel` as "gray8", "gray16le" or "grayf32le", `size` as "640x512". Throws UsageError.
RawFormat raw_format(std::string_view pixel, std::string_view size);

/// Frames out of a file, a named pipe or, with "-", standard input, each as soon as it is whole;
/// 1 / `frame_rate` [s] apart (1 s). Throws UsageError if it cannot be read; next() throws
/// std::runtime_error if the stream ends inside a frame.
std::unique_ptr<Source> open_raw(const std::string& path, const RawFormat& format,
                                 std::optional<double> frame_rate = std::nullopt);

}  // namespace glint

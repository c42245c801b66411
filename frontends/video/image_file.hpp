// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <string>

#include "glint/engine/scheduler.hpp"
#include "glint/kernels/core/frame.hpp"

namespace glint {

/// An image file with the bits that it has (16-bit stays 16-bit), or all pages of a TIFF, a few in
/// memory at a time. Throws std::runtime_error that names the file if it is damaged.
std::unique_ptr<Source> open_image(const std::string& path);

/// Writes one grey frame as 32-bit float TIFF, or rounded and clamped to 0..65535 as 16-bit TIFF
/// or PNG. Throws std::runtime_error if the file cannot be written.
enum class ImageDepth { bits16, float32 };
void write_image(const std::string& path, FrameView frame, ImageDepth depth);

}  // namespace glint

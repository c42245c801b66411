// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/files/cropped_source.hpp"

#include <fmt/core.h>

#include <stdexcept>
#include <variant>

namespace glint {

std::optional<SourceFrame> CroppedSource::next() {
  auto frame = source_->next();
  if (!frame) return std::nullopt;
  RawPixels& pixels = frame->pixels;
  if (box_.x0 < 0 || box_.y0 < 0 || box_.x1 > pixels.width || box_.y1 > pixels.height) {
    throw std::runtime_error(
        fmt::format("columns {} to {} and rows {} to {} are not all in frames of {}x{} px", box_.x0,
                    box_.x1 - 1, box_.y0, box_.y1 - 1, pixels.width, pixels.height));
  }
  const std::ptrdiff_t offset = box_.y0 * pixels.pitch + std::ptrdiff_t{box_.x0} * pixels.channels;
  std::visit([&](auto& data) { data += offset; }, pixels.data);
  pixels.width = box_.x1 - box_.x0, pixels.height = box_.y1 - box_.y0;
  return frame;
}

}  // namespace glint

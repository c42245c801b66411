// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/state/fields.hpp"

#include <algorithm>

#include "glint/kernels/core/cells.hpp"

namespace glint {

// 0: no frame; up to the number of those that were there before: one of them; one more: a new one.
void ByteWriter::frame(const Frame& frame) {
  const auto same = [&](const Frame& other) { return other.view().data == frame.view().data; };
  const auto found = std::ranges::find_if(frames_, same);
  const std::uint64_t number =
      frame.view().empty() ? 0 : static_cast<std::uint64_t>(found - frames_.begin()) + 1;
  put_bytes(*this, number);
  if (number <= frames_.size()) return;
  detail::put_image(*this, frame.view());
  frames_.push_back(frame);
}

Frame ByteReader::frame() {
  std::uint64_t number = 0;
  take_bytes(*this, number);
  if (number == 0) return {};
  require_bytes(number <= frames_.size() + 1, "there is no such frame");
  if (number == frames_.size() + 1) {
    frames_.emplace_back(detail::take_image<float>(*this));
    require_bytes(!frames_.back().view().empty(), "a frame has no pixels");
  }
  return frames_[static_cast<std::size_t>(number) - 1];
}

void detail::take_size(ByteReader& from, std::size_t pixel, int& width, int& height) {
  take_bytes(from, width), take_bytes(from, height);
  require_bytes(width >= 0 && height >= 0 && width <= kMaxSide && height <= kMaxSide &&
                    (width == 0) == (height == 0),
                "an image has no such size");
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  require_bytes(pixels <= from.left() / pixel, "the bytes end early");
}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/files/sequence.hpp"

#include <fmt/core.h>

#include <stdexcept>
#include <utility>

namespace glint {

SequenceSource::SequenceSource(std::vector<std::string> files, Open open,
                               std::optional<double> frame_rate,
                               std::optional<std::int64_t> frame_count)
    : files_(std::move(files)), open_(std::move(open)), current_(open_(files_.front())) {
  frame_rate_ = frame_rate.value_or(current_->frame_rate());
  frame_count_ = files_.size() == 1 ? current_->frame_count() : frame_count;
}

std::optional<SourceFrame> SequenceSource::next() {
  while (current_) {
    if (auto frame = current_->next()) {
      check_size(frame->pixels);
      frame->time = static_cast<double>(frame_++) / frame_rate_;
      return frame;
    }
    current_ = ++file_ < files_.size() ? open_(files_[file_]) : nullptr;
  }
  return std::nullopt;
}

void SequenceSource::check_size(const RawPixels& pixels) {
  if (frame_ == 0) {
    width_ = pixels.width;
    height_ = pixels.height;
  }
  if (pixels.width == width_ && pixels.height == height_) return;
  throw std::runtime_error(fmt::format(
      "{}: frame {} is {}x{}, but the frames from {} on are {}x{}; give frames of one "
      "size",
      files_[file_], frame_, pixels.width, pixels.height, files_.front(), width_, height_));
}

}  // namespace glint

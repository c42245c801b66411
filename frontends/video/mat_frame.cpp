// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/video/mat_frame.hpp"

#include <stdexcept>

namespace glint {

SourceFrame mat_frame(cv::Mat mat, const std::string& path) {
  if (mat.channels() == 2) cv::extractChannel(mat, mat, 0);
  if (mat.channels() > 4) {
    throw std::runtime_error(path + ": has " + std::to_string(mat.channels()) +
                             " channels; give grey, BGR or BGRA frames");
  }
  const int depth = mat.depth();
  if (depth != CV_8U && depth != CV_16U && depth != CV_32F) mat.convertTo(mat, CV_32F);
  auto owner = std::make_shared<const cv::Mat>(std::move(mat));
  SourceFrame frame;
  if (depth == CV_8U) {
    frame.pixels.data = owner->ptr<std::uint8_t>();
  } else if (depth == CV_16U) {
    frame.pixels.data = owner->ptr<std::uint16_t>();
  } else {
    frame.pixels.data = owner->ptr<float>();
  }
  frame.pixels.width = owner->cols;
  frame.pixels.height = owner->rows;
  frame.pixels.channels = owner->channels();
  frame.pixels.pitch = static_cast<std::ptrdiff_t>(owner->step1());
  frame.owner = std::move(owner);
  return frame;
}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <opencv2/core.hpp>
#include <string>

#include "glint/engine/scheduler.hpp"

namespace glint {

/// An OpenCV image as a source frame that keeps it alive. 8 and 16 bits and float pass as they are,
/// other depths become float, a second channel (alpha of grey) is dropped. `path` is for errors.
SourceFrame mat_frame(cv::Mat mat, const std::string& path);

}  // namespace glint

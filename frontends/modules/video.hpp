// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <span>
#include <string>

#include "glint/frontends/video/image_file.hpp"
#include "glint/frontends/video/overlay.hpp"
#include "glint/frontends/video/plot.hpp"
#include "glint/frontends/video/video_file.hpp"

namespace glint {

/// What is done with OpenCV; each entry is the function of its name in frontends/video.
struct VideoFunctions {
  decltype(&glint::open_image) open_image;
  decltype(&glint::write_image) write_image;
  decltype(&glint::open_video) open_video;
  decltype(&glint::video_backends) video_backends;
  decltype(&glint::overlay_video) overlay_video;
  decltype(&glint::overlay_picture) overlay_picture;
  decltype(&glint::write_plot) write_plot;
};

/// Whether this program was built with OpenCV.
bool has_video();
/// The module of these functions, opened by the first call. Throws as open_module() does.
const VideoFunctions& video();

}  // namespace glint

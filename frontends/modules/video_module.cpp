// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/modules/video.hpp"

extern "C" const void* glint_module() {
  static constexpr glint::VideoFunctions kFunctions{
      .open_image = glint::open_image,
      .write_image = glint::write_image,
      .open_video = glint::open_video,
      .video_backends = glint::video_backends,
      .overlay_video = glint::overlay_video,
      .overlay_picture = glint::overlay_picture,
      .write_plot = glint::write_plot,
  };
  glint::quiet_video_libraries();
  return &kFunctions;
}

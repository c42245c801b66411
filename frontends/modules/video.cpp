// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/modules/video.hpp"

#include "glint/frontends/modules/module.hpp"

namespace glint {

#ifdef GLINT_WITH_OPENCV
bool has_video() { return true; }
#else
bool has_video() { return false; }
#endif

const VideoFunctions& video() {
  static const auto* const table = static_cast<const VideoFunctions*>(open_module("video"));
  return *table;
}

}  // namespace glint

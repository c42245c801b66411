// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <string>

#include "glint/engine/scheduler.hpp"
#include "glint/frontends/usage_error.hpp"

namespace glint {

/// A video file through FFmpeg, 8 bits a channel; 16-bit grey through GStreamer where this OpenCV
/// has it. Throws std::runtime_error that names the file if it cannot be opened or holds no frame.
/// Warns if it ends before the frame that its header announces, and if 16 bits are read as 8.
std::unique_ptr<Source> open_video(const std::string& path, const Warn& warn);

/// What OpenCV reads videos with here: "FFmpeg", "FFmpeg, GStreamer (16-bit video)".
std::string video_backends();

/// Keeps OpenCV and FFmpeg from writing to stderr, unless their own environment variables say so.
/// For programs: it changes the environment.
void quiet_video_libraries();

}  // namespace glint

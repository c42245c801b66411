// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <string>

#include "glint/engine/scheduler.hpp"
#include "glint/frontends/usage_error.hpp"

namespace glint {

/// A sink with something to do at the end. finish() is also called after a failed run.
class ClosingSink : public Sink {
 public:
  virtual void finish() = 0;
  virtual std::string path() const = 0;  ///< of what was written
};

/// MPEG-4 part 2, or H.264: smaller files, which browsers play too, for ten times the work.
enum class OverlayCodec { mpeg4, h264 };

/// Writes a video of the frames with the tracks drawn on them: .mp4 and .mkv in `codec`, .avi in
/// motion JPEG. If no such encoder is there, the other one is taken, else motion JPEG is written
/// into an .avi of the same name, each with a warning. Without frames no file is left. Throws
/// UsageError if the path cannot be written or does not end in .mp4, .avi or .mkv.
std::unique_ptr<ClosingSink> overlay_video(const std::string& path, double frame_rate,
                                           OverlayCodec codec, const Warn& warn);

/// Writes one picture at the end: left the raw frame, right the same with tracks; of the last frame
/// with most to see: many confirmed tracks and long tails; none without frames. Throws UsageError
/// if the path cannot be written.
std::unique_ptr<ClosingSink> overlay_picture(const std::string& path);

}  // namespace glint

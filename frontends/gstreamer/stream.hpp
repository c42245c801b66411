// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <gst/video/video.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "glint/engine/engine.hpp"
#include "glint/frontends/gstreamer/settings.hpp"

namespace glint::gstreamer {

/// The trackers of one stream: pictures of one size and format, one after the other.
class Stream {
 public:
  /// Throws UsageError and ConfigError for settings that cannot be.
  explicit Stream(const Properties& properties);

  /// What the next pictures are. Throws UsageError if pictures of another size or format were
  /// tracked.
  void set_format(const GstVideoInfo& info);
  /// The tracks of a mapped picture, once they are known; the pixels are not needed after that, nor
  /// copied but where they are not aligned. Throws UsageError for a picture whose time is not
  /// known, and what ended the engine.
  EngineResult track(GstVideoFrame& picture, GstClockTime timestamp);
  /// Starts a track in the next picture where a structure "glint-start" says: x, y and, if known,
  /// vx, vy and sigma, all double. Throws std::invalid_argument for numbers that cannot be.
  void start(const GstStructure& target);
  /// Lets the trackers report what they hold back. Throws what ended the engine.
  const Scheduler& finish();

  const GstVideoInfo& format() const { return *format_; }
  const std::vector<std::string>& trackers() const { return trackers_; }

 private:
  double time_of(GstClockTime timestamp) const;

  std::vector<std::string> trackers_;
  std::unique_ptr<Engine> engine_;
  std::optional<GstVideoInfo> format_;
  std::int64_t frames_ = 0;
};

}  // namespace glint::gstreamer

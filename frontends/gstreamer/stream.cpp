// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/gstreamer/stream.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "glint/engine/run_config.hpp"
#include "glint/frontends/usage_error.hpp"

namespace glint::gstreamer {
namespace {

std::string text_of(const GstVideoInfo& info) {
  return std::to_string(GST_VIDEO_INFO_WIDTH(&info)) + "x" +
         std::to_string(GST_VIDEO_INFO_HEIGHT(&info)) + " " +
         gst_video_format_to_string(GST_VIDEO_INFO_FORMAT(&info));
}

template <class T>
SourceFrame frame_of(const GstVideoFrame& picture) {
  const auto* data = static_cast<const std::uint8_t*>(GST_VIDEO_FRAME_PLANE_DATA(&picture, 0));
  const std::ptrdiff_t stride = GST_VIDEO_FRAME_PLANE_STRIDE(&picture, 0);
  const int width = GST_VIDEO_FRAME_WIDTH(&picture), height = GST_VIDEO_FRAME_HEIGHT(&picture);
  constexpr std::ptrdiff_t kSize = sizeof(T);
  SourceFrame frame;
  if (stride % kSize == 0 && reinterpret_cast<std::uintptr_t>(data) % sizeof(T) == 0) {
    frame.pixels = {reinterpret_cast<const T*>(data), width, height, 1, stride / kSize};
    return frame;
  }
  const auto copy = std::make_shared_for_overwrite<T[]>(static_cast<std::size_t>(width) *
                                                        static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    std::memcpy(copy.get() + std::ptrdiff_t{y} * width, data + y * stride,
                static_cast<std::size_t>(width) * sizeof(T));
  }
  frame.pixels = {static_cast<const T*>(copy.get()), width, height, 1, width};
  frame.owner = copy;
  return frame;
}

}  // namespace

Stream::Stream(const Properties& properties) {
  const std::vector<ConfigSection> sections = sections_of(properties);
  trackers_ = trackers_of(section_named(sections, "run").as<RunConfig>());
  engine_ = std::make_unique<Engine>(pushed_frames_scheduler(sections));
}

void Stream::set_format(const GstVideoInfo& info) {
  const bool changed =
      format_ && (GST_VIDEO_INFO_WIDTH(&info) != GST_VIDEO_INFO_WIDTH(&*format_) ||
                  GST_VIDEO_INFO_HEIGHT(&info) != GST_VIDEO_INFO_HEIGHT(&*format_) ||
                  GST_VIDEO_INFO_FORMAT(&info) != GST_VIDEO_INFO_FORMAT(&*format_));
  if (changed && frames_ > 0) {
    throw UsageError("the pictures change from " + text_of(*format_) + " to " + text_of(info) +
                     " in mid-stream, and tracks cannot follow; put videoscale, videoconvert and "
                     "a caps filter in front of glinttrack");
  }
  format_ = info;
}

double Stream::time_of(GstClockTime timestamp) const {
  const int numerator = GST_VIDEO_INFO_FPS_N(&*format_);
  const double rate =
      numerator > 0 ? static_cast<double>(numerator) / GST_VIDEO_INFO_FPS_D(&*format_) : 0;
  if (!GST_CLOCK_TIME_IS_VALID(timestamp)) {
    if (rate > 0) return static_cast<double>(frames_) / rate;
    throw UsageError(
        "a picture has no time stamp and the stream no frame rate, so there is no time to track "
        "it at; put videorate in front of glinttrack, or set do-timestamp on the source");
  }
  const double time = static_cast<double>(timestamp) / static_cast<double>(GST_SECOND);
  // Time stamps are whole nanoseconds, and some elements add up rounded durations. Where one is
  // that of a frame at the steady rate, the frame's own time is taken, as a file read without
  // GStreamer has it.
  constexpr double kClose = 1e-3;  // [frames]
  const double frame = time * rate, whole = std::round(frame);
  return rate > 0 && std::abs(whole - frame) <= kClose ? whole / rate : time;
}

EngineResult Stream::track(GstVideoFrame& picture, GstClockTime timestamp) {
  const double time = time_of(timestamp);
  SourceFrame frame = GST_VIDEO_FRAME_FORMAT(&picture) == GST_VIDEO_FORMAT_GRAY8
                          ? frame_of<std::uint8_t>(picture)
                          : frame_of<std::uint16_t>(picture);
  frame.time = time;
  ++frames_;
  engine_->push(std::move(frame));
  engine_->drain();
  auto result = engine_->poll();
  if (!result) throw std::logic_error("a tracked frame has no result");
  return std::move(*result);
}

void Stream::start(const GstStructure& target) {
  const auto number = [&](const char* name) {
    double value = Cue::kUnknown;
    gst_structure_get_double(&target, name, &value);
    return value;
  };
  engine_->start(number("x"), number("y"), number("vx"), number("vy"), number("sigma"));
}

const Scheduler& Stream::finish() {
  engine_->finish();
  return engine_->scheduler();
}

}  // namespace glint::gstreamer

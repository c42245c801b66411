// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/video/video_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/videoio.hpp>
#include <opencv2/videoio/registry.hpp>
#include <stdexcept>
#include <utility>

#include "glint/frontends/video/mat_frame.hpp"

namespace glint {
namespace {

bool has_backend(cv::VideoCaptureAPIs api) {
  const auto backends = cv::videoio_registry::getBackends();
  return std::ranges::find(backends, api) != backends.end();
}

cv::VideoCapture open_eight_bit(const std::string& path) {
  for (const auto api : {cv::CAP_FFMPEG, cv::CAP_GSTREAMER, cv::CAP_OPENCV_MJPEG}) {
    cv::VideoCapture capture;
    if (has_backend(api) && capture.open(path, api)) return capture;
  }
  throw std::runtime_error(
      path +
      ": cannot be opened as a video (damaged, truncated, or a codec that OpenCV lacks); "
      "copy it again, or convert it to PNG files");
}

/// FFmpeg's tag of a raw pixel format is a letter, a letter or digit, 0 or 10, and the depth.
int bits_a_channel(const cv::VideoCapture& capture) {
  const auto tag = static_cast<unsigned>(capture.get(cv::CAP_PROP_CODEC_PIXEL_FORMAT));
  const unsigned depth = tag >> 24;
  return depth > 8 && depth <= 16 ? static_cast<int>(depth) : 8;
}

bool open_sixteen_bit(cv::VideoCapture& capture, const std::string& path) {
  if (!has_backend(cv::CAP_GSTREAMER)) return false;
  cv::VideoCapture deep(
      "filesrc location=\"" + path +
          "\" ! decodebin ! videoconvert ! video/x-raw,format=GRAY16_LE ! appsink sync=false",
      cv::CAP_GSTREAMER);
  if (!deep.isOpened()) return false;
  capture = deep;  // shares the reader
  return true;
}

class VideoSource : public Source {
 public:
  VideoSource(std::string path, Warn warn)
      : path_(std::move(path)), warn_(std::move(warn)), capture_(open_eight_bit(path_)) {
    read_header();
    const int bits = bits_a_channel(capture_);
    if (bits > 8 && !open_sixteen_bit(capture_, path_)) {
      warn_(
          fmt::format("{}: {} bits a channel are read as 8, as this OpenCV has no GStreamer that "
                      "decodes them; convert it to 16-bit PNG or TIFF files to keep them",
                      path_, bits));
    }
    if (!read(first_)) {
      throw std::runtime_error(path_ + ": no frame can be decoded; copy it again, or convert it");
    }
  }

  std::optional<SourceFrame> next() override {
    cv::Mat image = std::exchange(first_, cv::Mat());
    if (image.empty() && !read(image)) {
      warn_if_short();
      return std::nullopt;
    }
    ++frames_;
    return mat_frame(std::move(image), path_);
  }
  std::optional<std::int64_t> frame_count() const override { return announced_; }
  double frame_rate() const override { return frame_rate_; }

 private:
  void read_header() {
    const double count = capture_.get(cv::CAP_PROP_FRAME_COUNT);
    if (count >= 1 && count < 1e12) announced_ = static_cast<std::int64_t>(count);
    const double rate = capture_.get(cv::CAP_PROP_FPS);
    if (std::isfinite(rate) && rate > 0) {
      frame_rate_ = rate;
    } else {
      warn_(path_ + ": names no frame rate; taking 30 frames/s, give --fps for another");
    }
  }

  bool read(cv::Mat& image) {
    try {
      return capture_.read(image) && !image.empty();
    } catch (const cv::Exception&) {
      return false;
    }
  }

  void warn_if_short() {
    if (!announced_ || frames_ >= *announced_) return;
    warn_(
        fmt::format("{}: ends after {} frames, its header announces {} (truncated or damaged?); "
                    "going on with those",
                    path_, frames_, *announced_));
    announced_.reset();
  }

  std::string path_;
  Warn warn_;
  cv::VideoCapture capture_;
  cv::Mat first_;
  std::optional<std::int64_t> announced_;
  std::int64_t frames_ = 0;
  double frame_rate_ = 30;
};

}  // namespace

std::unique_ptr<Source> open_video(const std::string& path, const Warn& warn) {
  return std::make_unique<VideoSource>(path, warn);
}

std::string video_backends() {
  std::string names = has_backend(cv::CAP_FFMPEG) ? "FFmpeg" : "";
  if (has_backend(cv::CAP_GSTREAMER)) {
    names += names.empty() ? "" : ", ";
    names += "GStreamer (16-bit video)";
  }
  return names.empty() ? "motion JPEG only" : names;
}

void quiet_video_libraries() {
  constexpr const char* kFfmpegQuiet = "-8";  // AV_LOG_QUIET
  setenv("OPENCV_FFMPEG_LOGLEVEL", kFfmpegQuiet, 0);
  if (!std::getenv("OPENCV_LOG_LEVEL")) {
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  }
}

}  // namespace glint

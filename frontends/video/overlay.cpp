// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/video/overlay.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <stdexcept>
#include <utility>

#include "glint/frontends/video/painter.hpp"

namespace glint {
namespace {

namespace fs = std::filesystem;

/// Encoders fail late and with little to say.
void check_writable(const std::string& path) {
  if (!std::ofstream(path, std::ios::app)) {
    throw UsageError(path + ": cannot be written; check the folder and its permissions");
  }
}

/// A file that was only opened to see whether it can be written.
void remove_if_empty(const std::string& path) {
  std::error_code ignored;
  if (fs::is_regular_file(path, ignored) && fs::is_empty(path, ignored)) fs::remove(path, ignored);
}

class OverlayVideo : public ClosingSink {
 public:
  OverlayVideo(std::string path, double frame_rate, OverlayCodec codec, Warn warn)
      : path_(std::move(path)), frame_rate_(frame_rate), codec_(codec), warn_(std::move(warn)) {
    const std::string extension = fs::path(path_).extension().string();
    if (extension != ".mp4" && extension != ".avi" && extension != ".mkv") {
      throw UsageError(path_ + ": end the overlay's name in .mp4, .avi or .mkv");
    }
    check_writable(path_);
  }
  void take(const ScanResult& result) override {
    constexpr double kSteady = 0.9;
    painter_.follow(result.reported);
    cv::Mat picture = painter_.grey(result.scan.raw.view(), kSteady);
    painter_.draw(picture, painter_.tails());
    // encoders want even sides
    picture =
        picture(cv::Rect(0, 0, std::max(2, picture.cols & ~1), std::max(2, picture.rows & ~1)));
    if (!writer_.isOpened()) open(picture.size());
    writer_.write(picture);
  }
  void finish() override {
    writer_.release();
    remove_if_empty(path_);
  }
  std::string path() const override { return path_; }

 private:
  bool try_open(const std::string& path, const char (&code)[5], cv::Size size) {
    const int fourcc = cv::VideoWriter::fourcc(code[0], code[1], code[2], code[3]);
    try {
      return writer_.open(path, fourcc, frame_rate_, size);
    } catch (const cv::Exception&) {
      return false;
    }
  }

  bool open_codec(OverlayCodec codec, cv::Size size) {
    return codec == OverlayCodec::h264 ? try_open(path_, "avc1", size)
                                       : try_open(path_, "mp4v", size);
  }

  bool open_either_codec(cv::Size size) {
    if (open_codec(codec_, size)) return true;
    const bool h264 = codec_ == OverlayCodec::h264;
    if (!open_codec(h264 ? OverlayCodec::mpeg4 : OverlayCodec::h264, size)) return false;
    warn_(path_ + (h264 ? ": no H.264 encoder here; writing MPEG-4"
                        : ": no MPEG-4 encoder here; writing H.264"));
    return true;
  }

  void open(cv::Size size) {
    const bool avi = path_.ends_with(".avi");
    if (!avi && open_either_codec(size)) return;
    const std::string other = fs::path(path_).replace_extension(".avi").string();
    if (!try_open(other, "MJPG", size)) {
      throw std::runtime_error(path_ +
                               ": OpenCV has no encoder for it; leave --overlay out, or use "
                               "--picture");
    }
    if (avi) return;
    warn_(path_ + ": no H.264 or MPEG-4 encoder here; writing motion JPEG to " + other);
    std::error_code ignored;
    fs::remove(path_, ignored);
    path_ = other;
  }

  std::string path_;
  double frame_rate_;
  OverlayCodec codec_;
  Warn warn_;
  Painter painter_{640};  // larger noise takes H.264 100 ms a frame
  cv::VideoWriter writer_;
};

class OverlayPicture : public ClosingSink {
 public:
  explicit OverlayPicture(std::string path) : path_(std::move(path)) {
    if (!cv::haveImageWriter(path_)) {
      throw UsageError(path_ + ": unknown kind of picture; end its name in .png or .jpg");
    }
    check_writable(path_);
  }
  void take(const ScanResult& result) override {
    painter_.follow(result.reported);
    std::size_t followed = 0;
    for (const auto& [track, tail] : painter_.tails()) {
      if (tail.back().status == TrackStatus::confirmed) followed += tail.size();
    }
    if (frame_ && followed < most_) return;
    most_ = followed;
    frame_ = result.scan.raw;
    tails_ = painter_.tails();
  }
  void finish() override {
    if (!frame_) return remove_if_empty(path_);
    const cv::Mat raw = painter_.grey(frame_.view(), 0);
    cv::Mat tracked = raw.clone();
    painter_.draw(tracked, tails_);
    const cv::Mat gap(raw.rows, 8, raw.type(), cv::Scalar(255, 255, 255));
    cv::Mat both;
    const bool wide = raw.cols > 2 * raw.rows;  // then one above the other
    if (wide) {
      const cv::Mat rule(8, raw.cols, raw.type(), cv::Scalar(255, 255, 255));
      cv::vconcat(std::array{raw, rule, tracked}, both);
    } else {
      cv::hconcat(std::array{raw, gap, tracked}, both);
    }
    if (!cv::imwrite(path_, both)) {
      throw std::runtime_error(path_ + ": cannot be written; is the disk full?");
    }
  }
  std::string path() const override { return path_; }

 private:
  std::string path_;
  Painter painter_{960};
  Frame frame_;
  Painter::Tails tails_;
  std::size_t most_ = 0;
};

}  // namespace

std::unique_ptr<ClosingSink> overlay_video(const std::string& path, double frame_rate,
                                           OverlayCodec codec, const Warn& warn) {
  return std::make_unique<OverlayVideo>(path, frame_rate, codec, warn);
}

std::unique_ptr<ClosingSink> overlay_picture(const std::string& path) {
  return std::make_unique<OverlayPicture>(path);
}

}  // namespace glint

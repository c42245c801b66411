// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/video/image_file.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <vector>

#include "glint/frontends/files/inputs.hpp"
#include "glint/frontends/video/mat_frame.hpp"

namespace glint {
namespace {

[[noreturn]] void refuse(const std::string& path) {
  throw std::runtime_error(path +
                           ": cannot be read as an image (damaged, truncated, or not an "
                           "image); remove it or make it again");
}

/// JPEG decoders fill what is missing with grey and say nothing; a whole file ends with a marker.
bool truncated_jpeg(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const auto size = static_cast<std::streamoff>(file.tellg());
  std::array<char, 1024> tail{};
  const std::streamoff length = std::min<std::streamoff>(size, tail.size());
  file.seekg(0).read(tail.data(), 2);
  if (tail[0] != '\xff' || tail[1] != '\xd8') return false;
  file.seekg(size - length).read(tail.data(), length);
  return std::string_view(tail.data(), static_cast<std::size_t>(length)).find("\xff\xd9") ==
         std::string_view::npos;
}

class ImageSource : public Source {
 public:
  explicit ImageSource(std::string path) : path_(std::move(path)) {}
  std::optional<SourceFrame> next() override {
    if (read_) return std::nullopt;
    read_ = true;
    cv::Mat image;
    try {
      image = cv::imread(path_, cv::IMREAD_UNCHANGED);
    } catch (const cv::Exception&) {
      refuse(path_);
    }
    if (image.empty() || truncated_jpeg(path_)) refuse(path_);
    return mat_frame(std::move(image), path_);
  }
  std::optional<std::int64_t> frame_count() const override { return 1; }

 private:
  std::string path_;
  bool read_ = false;
};

class TiffSource : public Source {
 public:
  explicit TiffSource(std::string path) : path_(std::move(path)) {
    try {
      pages_ = static_cast<int>(cv::imcount(path_, cv::IMREAD_UNCHANGED));
    } catch (const cv::Exception&) {
    }
    if (pages_ <= 0) refuse(path_);
  }
  std::optional<SourceFrame> next() override {
    if (page_ == pages_) return std::nullopt;
    if (next_ == chunk_.size()) read_chunk();
    ++page_;
    return mat_frame(std::move(chunk_[next_++]), path_);
  }
  std::optional<std::int64_t> frame_count() const override { return pages_; }

 private:
  /// Each read walks the pages from the first, so it should bring several.
  void read_chunk() {
    const int count = std::min(page_ == 0 ? 1 : chunk_pages_, pages_ - page_);
    chunk_.clear();
    next_ = 0;
    try {
      cv::imreadmulti(path_, chunk_, page_, count, cv::IMREAD_UNCHANGED);
    } catch (const cv::Exception&) {
      chunk_.clear();
    }
    if (static_cast<int>(chunk_.size()) != count || chunk_.front().empty()) refuse(path_);
    constexpr std::size_t kChunkBytes = std::size_t{64} << 20;
    const std::size_t bytes = chunk_.front().total() * chunk_.front().elemSize();
    chunk_pages_ = static_cast<int>(std::clamp<std::size_t>(kChunkBytes / bytes, 1, 256));
  }

  std::string path_;
  std::vector<cv::Mat> chunk_;
  std::size_t next_ = 0;
  int pages_ = 0, page_ = 0, chunk_pages_ = 1;
};

}  // namespace

std::unique_ptr<Source> open_image(const std::string& path) {
  if (kind_of(path) == InputKind::tiff) return std::make_unique<TiffSource>(path);
  return std::make_unique<ImageSource>(path);
}

void write_image(const std::string& path, FrameView frame, ImageDepth depth) {
  cv::Mat image(frame.height, frame.width, CV_32F, const_cast<float*>(frame.data),
                static_cast<std::size_t>(frame.pitch) * sizeof(float));
  if (depth == ImageDepth::bits16) image.convertTo(image, CV_16U);
  bool written = false;
  try {
    written = cv::imwrite(path, image);
  } catch (const cv::Exception&) {
  }
  if (!written) throw std::runtime_error(path + ": cannot be written; check the folder and disk");
}

}  // namespace glint

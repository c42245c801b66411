// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/files/raw_stream.hpp"

#include <fmt/core.h>

#include <charconv>
#include <cstdio>
#include <stdexcept>
#include <vector>

#include "glint/frontends/usage_error.hpp"

namespace glint {
namespace {

std::optional<int> side(std::string_view text) {
  constexpr int kMost = 65535;
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  if (number < 1 || number > kMost) return std::nullopt;
  return number;
}

std::size_t bytes_of(RawFormat::Pixel pixel) {
  switch (pixel) {
    case RawFormat::Pixel::gray8:
      return 1;
    case RawFormat::Pixel::gray16le:
      return 2;
    default:
      return 4;
  }
}

/// Read with stdio, which returns from a pipe as soon as the frame is whole.
class RawSource : public Source {
 public:
  RawSource(const std::string& path, const RawFormat& format, double frame_rate)
      : name_(path == "-" ? "standard input" : path), format_(format), frame_rate_(frame_rate) {
    file_ = path == "-" ? stdin : std::fopen(path.c_str(), "rb");
    if (!file_) throw UsageError(path + ": cannot be read; check the path and its permissions");
    // Whole frames are asked for: stdio's own buffer would only copy them once more.
    std::setvbuf(file_, nullptr, _IONBF, 0);
  }
  ~RawSource() override {
    if (file_ != stdin) std::fclose(file_);
  }
  RawSource(const RawSource&) = delete;
  RawSource& operator=(const RawSource&) = delete;

  std::optional<SourceFrame> next() override {
    const std::size_t need = static_cast<std::size_t>(format_.width) *
                             static_cast<std::size_t>(format_.height) * bytes_of(format_.pixel);
    auto bytes = std::make_shared<std::vector<std::byte>>(need);
    const std::size_t have = std::fread(bytes->data(), 1, need, file_);
    if (have == 0) return std::nullopt;
    if (have < need) {
      throw std::runtime_error(fmt::format(
          "{}: ends after {} of the {} bytes of frame {}; were --format and --size right?", name_,
          have, need, frame_));
    }
    SourceFrame frame;
    frame.pixels = {pixels(bytes->data()), format_.width, format_.height, 1, format_.width};
    frame.owner = std::move(bytes);
    frame.time = static_cast<double>(frame_++) / frame_rate_;
    return frame;
  }
  double frame_rate() const override { return frame_rate_; }

 private:
  decltype(RawPixels::data) pixels(const std::byte* bytes) const {
    switch (format_.pixel) {
      case RawFormat::Pixel::gray8:
        return reinterpret_cast<const std::uint8_t*>(bytes);
      case RawFormat::Pixel::gray16le:
        return reinterpret_cast<const std::uint16_t*>(bytes);
      default:
        return reinterpret_cast<const float*>(bytes);
    }
  }

  std::string name_;
  RawFormat format_;
  double frame_rate_;  // [1/s]
  std::FILE* file_;
  std::int64_t frame_ = 0;
};

}  // namespace

RawFormat raw_format(std::string_view pixel, std::string_view size) {
  RawFormat format;
  if (pixel == "gray8") {
    format.pixel = RawFormat::Pixel::gray8;
  } else if (pixel == "gray16le") {
    format.pixel = RawFormat::Pixel::gray16le;
  } else if (pixel == "grayf32le") {
    format.pixel = RawFormat::Pixel::grayf32le;
  } else {
    throw UsageError(
        fmt::format("--format must be gray8, gray16le or grayf32le, got \"{}\"", pixel));
  }
  const std::size_t x = size.find('x');
  const auto width = side(size.substr(0, x));
  const auto height = x == std::string_view::npos ? std::nullopt : side(size.substr(x + 1));
  if (!width || !height) {
    throw UsageError(fmt::format(
        "--size must be width x height of the raw frames, such as 640x512, got \"{}\"", size));
  }
  format.width = *width, format.height = *height;
  return format;
}

std::unique_ptr<Source> open_raw(const std::string& path, const RawFormat& format,
                                 std::optional<double> frame_rate) {
  return std::make_unique<RawSource>(path, format, frame_rate.value_or(1));
}

}  // namespace glint

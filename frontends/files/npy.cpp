// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/files/npy.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "glint/frontends/usage_error.hpp"

namespace glint {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";

struct NpyHeader {
  std::string type;                 ///< numpy's, e.g. "<u2"
  std::vector<std::int64_t> shape;  ///< one or two numbers fewer than three mean one frame
  std::size_t data = 0;             ///< where the pixels start [bytes]
};

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw std::runtime_error(path + ": " + why);
}

/// The text behind 'key': in the header's dictionary.
std::string_view value_of(const std::string& path, std::string_view dictionary,
                          std::string_view key) {
  const std::size_t at = dictionary.find(fmt::format("'{}':", key));
  if (at == std::string_view::npos) refuse(path, fmt::format("no '{}' in the .npy header", key));
  std::string_view value = dictionary.substr(at + key.size() + 3);
  value.remove_prefix(std::min(value.find_first_not_of(' '), value.size()));
  return value;
}

std::vector<std::int64_t> parse_shape(std::string_view text) {
  std::vector<std::int64_t> shape;
  text = text.substr(0, text.find(')'));
  while (true) {
    const std::size_t at = text.find_first_of("0123456789");
    if (at == std::string_view::npos) return shape;
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), number);
    shape.push_back(error == std::errc{} ? number : -1);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  }
}

NpyHeader read_header(const std::string& path, std::ifstream& file) {
  std::array<char, 12> start{};
  file.read(start.data(), 10);
  if (!file || std::string_view(start.data(), kMagic.size()) != kMagic) {
    refuse(path,
           "no .npy file (it does not start with the magic string); write it with numpy.save");
  }
  const auto byte = [&](int i) {
    return static_cast<std::size_t>(static_cast<unsigned char>(start[static_cast<std::size_t>(i)]));
  };
  NpyHeader header;
  std::size_t length = byte(8) | byte(9) << 8;
  header.data = 10 + length;
  if (byte(6) >= 2) {  // from format version 2 on the length has four bytes
    file.read(start.data() + 10, 2);
    length |= byte(10) << 16 | byte(11) << 24;
    header.data = 12 + length;
  }
  if (length > std::filesystem::file_size(path)) refuse(path, "truncated inside the .npy header");
  std::string dictionary(length, ' ');
  file.read(dictionary.data(), static_cast<std::streamsize>(length));
  if (!file) refuse(path, "truncated inside the .npy header");
  header.type = std::string(value_of(path, dictionary, "descr"));
  if (header.type.empty()) refuse(path, "no type behind 'descr' in the .npy header");
  header.type = header.type.substr(1, header.type.find_first_of("'\"", 1) - 1);
  if (value_of(path, dictionary, "fortran_order").starts_with("True")) {
    refuse(path, "is in Fortran order; save numpy.ascontiguousarray(cube)");
  }
  header.shape = parse_shape(value_of(path, dictionary, "shape"));
  return header;
}

std::size_t element_size(const std::string& path, const std::string& type) {
  if (type == "|u1" || type == "<u1") return 1;
  if (type == "<u2") return 2;
  if (type == "<f4") return 4;
  if (type == "<f8") return 8;
  refuse(path, fmt::format("holds elements of type '{}'; glint reads uint8, uint16, float32 and "
                           "float64, little endian: save cube.astype('float32')",
                           type));
}

class NpySource : public Source {
 public:
  explicit NpySource(const std::string& path) : path_(path), file_(path, std::ios::binary) {
    if (!file_) refuse(path, "cannot be read; check its permissions");
    const NpyHeader header = read_header(path, file_);
    size_ = element_size(path, header.type);
    set_shape(header.shape);
    const std::uintmax_t have = std::filesystem::file_size(path);
    const std::uintmax_t room = have > header.data ? have - header.data : 0;
    // By division: what a header asks for may have no number.
    if (room / frame_bytes() < static_cast<std::uintmax_t>(frames_)) {
      refuse(path, fmt::format("truncated: {} bytes are there for {} frames of {}; copy or save it "
                               "again",
                               room, frames_, frame_bytes()));
    }
    file_.seekg(static_cast<std::streamoff>(header.data));
  }

  std::optional<SourceFrame> next() override {
    if (frame_ == frames_) return std::nullopt;
    ++frame_;
    // new is aligned for every element type
    auto bytes = std::shared_ptr<char[]>(new char[frame_bytes()]);
    file_.read(bytes.get(), static_cast<std::streamsize>(frame_bytes()));
    if (!file_) refuse(path_, fmt::format("frame {} cannot be read", frame_ - 1));
    SourceFrame frame;
    frame.pixels = {pixels(bytes.get()), width_, height_, 1, width_};
    frame.owner = std::move(bytes);
    return frame;
  }
  std::optional<std::int64_t> frame_count() const override { return frames_; }

 private:
  std::size_t frame_bytes() const {
    return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) * size_;
  }

  void set_shape(const std::vector<std::int64_t>& shape) {
    constexpr std::int64_t kMaxSide = 1 << 20;
    const std::size_t n = shape.size();
    if ((n != 2 && n != 3) || std::ranges::any_of(shape, [](auto s) { return s < 0; }) ||
        shape[n - 1] > kMaxSide || shape[n - 2] > kMaxSide) {
      refuse(path_, fmt::format("has {} axes; glint reads (frames, height, width) or (height, "
                                "width): reshape it",
                                n));
    }
    if (std::ranges::find(shape, 0) != shape.end()) {
      refuse(path_, fmt::format("has shape ({}): it holds no pixels; save at least one frame",
                                fmt::join(shape, ", ")));
    }
    frames_ = n == 3 ? shape[0] : 1;
    height_ = static_cast<int>(shape[n - 2]);
    width_ = static_cast<int>(shape[n - 1]);
  }

  decltype(RawPixels::data) pixels(char* bytes) const {
    if (size_ == 1) return reinterpret_cast<const std::uint8_t*>(bytes);
    if (size_ == 2) return reinterpret_cast<const std::uint16_t*>(bytes);
    auto* floats = reinterpret_cast<float*>(bytes);
    if (size_ == 8) narrow(bytes, floats);
    return static_cast<const float*>(floats);
  }

  /// double to float in place: each float is written behind the double that was read.
  void narrow(const char* bytes, float* floats) const {
    const std::size_t count = frame_bytes() / size_;
    for (std::size_t i = 0; i < count; ++i) {
      double value;
      std::memcpy(&value, bytes + 8 * i, 8);
      const auto narrowed = static_cast<float>(value);
      std::memcpy(floats + i, &narrowed, 4);
    }
  }

  std::string path_;
  std::ifstream file_;
  std::size_t size_ = 0;
  std::int64_t frames_ = 0, frame_ = 0;
  int width_ = 0, height_ = 0;
};

}  // namespace

std::unique_ptr<Source> open_npy(const std::string& path) {
  return std::make_unique<NpySource>(path);
}

NpyWriter::NpyWriter(const std::string& path) : path_(path), file_(path, std::ios::binary) {
  if (!file_) throw UsageError(path + ": cannot be written; check the folder and its permissions");
}

void NpyWriter::write(FrameView frame) {
  if (frames_ == 0) {
    width_ = frame.width;
    height_ = frame.height;
    write_header();
  }
  for (int y = 0; y < height_; ++y) {
    file_.write(reinterpret_cast<const char*>(frame.row(y)),
                static_cast<std::streamsize>(sizeof(float)) * width_);
  }
  ++frames_;
  write_header();
  if (!file_.flush()) throw std::runtime_error(path_ + ": cannot be written; is the disk full?");
}

void NpyWriter::write_header() {
  constexpr std::size_t kLength = 128;  // room for any shape, and a multiple of 64
  std::string text =
      fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}, {}, {}), }}", frames_,
                  height_, width_);
  text.resize(kLength - 11, ' ');
  file_.seekp(0);
  file_ << kMagic << '\x01' << '\0' << static_cast<char>(kLength - 10) << '\0' << text << '\n';
  file_.seekp(0, std::ios::end);
}

}  // namespace glint

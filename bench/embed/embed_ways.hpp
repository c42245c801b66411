// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "glint/bench/memory_source.hpp"

namespace glint::bench {

// What every way into the engine is given: 16-bit frames of dim targets, tracked with
// kEmbedTracker.
inline constexpr int kEmbedWidth = 640, kEmbedHeight = 512, kEmbedImages = 64;  // [px], [px], -
inline constexpr const char* kEmbedTracker = "mm-phd";

using EmbedScene = std::shared_ptr<const MemoryScene>;

/// A way into the engine: each call pushes that many more frames and takes their tracks. Returns
/// how long [s] the thread that does so was on a core meanwhile: what the way costs beside the
/// engine's own threads.
using Way = std::function<double(std::int64_t frames)>;

Way pushed_in_cpp(const EmbedScene& scene);
Way pushed_in_c(const EmbedScene& scene);

/// The pixels of a frame, rows one after the other.
std::vector<std::uint16_t> packed(const MemoryScene& scene, std::int64_t frame);

/// The scene's images in a file that is gone at the end.
class ImageFile {
 public:
  /// Throws std::runtime_error if it cannot be written.
  explicit ImageFile(const MemoryScene& scene);
  ~ImageFile();
  ImageFile(const ImageFile&) = delete;
  ImageFile& operator=(const ImageFile&) = delete;
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

/// In a process of Python's. Nothing, and a word on standard error, where Python or the module is
/// missing.
Way pushed_in_python(const ImageFile& images);

/// The path of this program.
std::filesystem::path program();

}  // namespace glint::bench

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <fstream>
#include <memory>
#include <string>

#include "glint/engine/scheduler.hpp"
#include "glint/kernels/core/frame.hpp"

namespace glint {

/// A .npy file of one frame (height, width) or a cube (frames, height, width); u1, u2, f4 or f8
/// (read as float), little endian, C order. Throws std::runtime_error that names the file if it is
/// anything else, or shorter than its header says.
std::unique_ptr<Source> open_npy(const std::string& path);

/// Writes a cube of float frames; the frame count in the header is put right after every frame.
class NpyWriter {
 public:
  /// Throws UsageError if the file cannot be written.
  explicit NpyWriter(const std::string& path);
  /// All frames must have the size of the first. Throws std::runtime_error if the disk is full.
  void write(FrameView frame);

 private:
  void write_header();

  std::string path_;
  std::ofstream file_;
  std::int64_t frames_ = 0;
  int width_ = 0, height_ = 0;
};

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "glint/engine/scheduler.hpp"

namespace glint {

/// Files one after the other as one stream, each opened when its turn comes. Numbers the frames
/// and gives them their times.
class SequenceSource : public Source {
 public:
  using Open = std::function<std::unique_ptr<Source>(const std::string& path)>;

  /// `files` must not be empty; opens the first. `frame_rate` [1/s] overrides that of the first.
  SequenceSource(std::vector<std::string> files, Open open, std::optional<double> frame_rate,
                 std::optional<std::int64_t> frame_count);
  /// Throws std::runtime_error that names the file and both sizes if the size changes.
  std::optional<SourceFrame> next() override;
  std::optional<std::int64_t> frame_count() const override { return frame_count_; }
  double frame_rate() const override { return frame_rate_; }

 private:
  void check_size(const RawPixels& pixels);

  std::vector<std::string> files_;
  Open open_;
  std::unique_ptr<Source> current_;
  std::size_t file_ = 0;
  std::int64_t frame_ = 0;
  int width_ = 0, height_ = 0;
  double frame_rate_;
  std::optional<std::int64_t> frame_count_;
};

}  // namespace glint

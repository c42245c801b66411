// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "glint/engine/scheduler.hpp"
#include "glint/kernels/core/frame.hpp"

namespace glint::bench {

/// Frames of sensor noise with slow targets (1 px/frame), held in memory and played forth and back,
/// so that targets never jump.
class MemoryScene {
 public:
  /// Frames that differ, how many of them in their noise too, how many targets and how bright [dB].
  struct Content {
    int frames = 16, noises = 4, targets = 20;
    double snr = 14;
  };
  struct Place {
    double x, y;  ///< [px]
  };
  MemoryScene(int width, int height, const Content& content);
  const Image<std::uint16_t>& frame(std::int64_t index) const;
  /// Where a target is at that frame.
  Place place(int target, std::int64_t index) const;
  int targets() const { return content_.targets; }

 private:
  std::int64_t image_at(std::int64_t index) const;
  Place place_in_image(int target, std::int64_t image) const;

  int width_, height_;
  Content content_;
  std::vector<Image<std::uint16_t>> frames_;
};

/// Plays a scene.
class MemorySource : public Source {
 public:
  MemorySource(const MemoryScene& scene, std::int64_t count) : scene_(scene), count_(count) {}
  std::optional<SourceFrame> next() override;
  /// Goes on after its end.
  void extend(std::int64_t frames) { count_ += frames; }
  std::optional<std::int64_t> frame_count() const override { return count_; }

 private:
  const MemoryScene& scene_;
  std::int64_t count_, at_ = 0;
};

}  // namespace glint::bench

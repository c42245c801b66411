// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "glint/engine/scheduler.hpp"
#include "glint/kernels/core/frame.hpp"

namespace glint::bench {

/// Frames of sensor noise with slow targets, held in memory.
class MemoryScene {
 public:
  /// Frames that differ, how many of them in their noise too, and how many targets.
  struct Content {
    int frames = 16, noises = 4, targets = 20;
  };
  MemoryScene(int width, int height, const Content& content);
  const Image<std::uint16_t>& frame(std::int64_t index) const;

 private:
  std::vector<Image<std::uint16_t>> frames_;
};

/// Plays a scene forth and back, so that targets never jump.
class MemorySource : public Source {
 public:
  MemorySource(const MemoryScene& scene, std::int64_t count) : scene_(scene), count_(count) {}
  std::optional<SourceFrame> next() override;
  std::optional<std::int64_t> frame_count() const override { return count_; }

 private:
  const MemoryScene& scene_;
  std::int64_t count_, at_ = 0;
};

}  // namespace glint::bench

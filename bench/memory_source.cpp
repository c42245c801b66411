// SPDX-License-Identifier: Apache-2.0
#include "glint/bench/memory_source.hpp"

#include <cmath>

#include "glint/bench/data.hpp"
#include "glint/kernels/core/point_spread.hpp"

namespace glint::bench {
namespace {

constexpr double kSpeed = 1;  // [px/frame]

// Adds a target of the given sensor counts over the whole point spread.
void stamp(ImageView<std::uint16_t> image, double x, double y, double counts) {
  const PointSpread spread = PointSpread::of(1);
  const int cx = static_cast<int>(std::floor(x + 0.5)), cy = static_cast<int>(std::floor(y + 0.5));
  for (int l = -spread.half_width; l <= spread.half_width; ++l) {
    for (int k = -spread.half_width; k <= spread.half_width; ++k) {
      if (!image.contains(cx + k, cy + l)) continue;
      const double h = counts * spread.weight(k, x - cx) * spread.weight(l, y - cy);
      std::uint16_t& pixel = image(cx + k, cy + l);
      pixel = static_cast<std::uint16_t>(pixel + std::lround(h));
    }
  }
}

}  // namespace

MemoryScene::MemoryScene(int width, int height, const Content& content)
    : width_(width), height_(height), content_(content) {
  for (int i = 0; i < content.frames; ++i) {
    frames_.push_back(i < content.noises
                          ? sensor_frame(width, height, static_cast<std::uint32_t>(i))
                          : frames_[static_cast<std::size_t>(i % content.noises)]);
  }
  const double counts = kSensorScale * PointSpread::of(1).intensity_of_snr(content.snr);
  for (int i = 0; i < content.frames; ++i) {
    for (int target = 0; target < content.targets; ++target) {
      const Place at = place_in_image(target, i);
      stamp(frames_[static_cast<std::size_t>(i)].view(), at.x, at.y, counts);
    }
  }
}

std::int64_t MemoryScene::image_at(std::int64_t index) const {
  const std::int64_t frames = content_.frames;
  const std::int64_t period = 2 * frames - 2, phase = index % period;
  return phase < frames ? phase : period - phase;
}

MemoryScene::Place MemoryScene::place_in_image(int target, std::int64_t image) const {
  const double room = width_ - kSpeed * content_.frames;
  return {(target + 0.5) * room / content_.targets + kSpeed * static_cast<double>(image),
          ((target * 7) % content_.targets + 0.5) * height_ / content_.targets};
}

const Image<std::uint16_t>& MemoryScene::frame(std::int64_t index) const {
  return frames_[static_cast<std::size_t>(image_at(index))];
}

MemoryScene::Place MemoryScene::place(int target, std::int64_t index) const {
  return place_in_image(target, image_at(index));
}

std::optional<SourceFrame> MemorySource::next() {
  if (at_ == count_) return std::nullopt;
  const auto view = scene_.frame(at_).view();
  SourceFrame frame;
  frame.pixels = {view.data, view.width, view.height, 1, view.pitch};
  frame.time = static_cast<double>(at_++);
  return frame;
}

}  // namespace glint::bench

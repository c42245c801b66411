// SPDX-License-Identifier: Apache-2.0
#include "glint/bench/memory_source.hpp"

#include <cmath>

#include "glint/bench/data.hpp"
#include "glint/kernels/core/point_spread.hpp"

namespace glint::bench {
namespace {

constexpr double kSpeed = 1, kSnr = 14;  // [px/frame], [dB]

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

MemoryScene::MemoryScene(int width, int height) {
  for (std::uint32_t i = 0; i < kNoises; ++i) frames_.push_back(sensor_frame(width, height, i));
  for (int i = kNoises; i < kFrames; ++i) {
    frames_.push_back(frames_[static_cast<std::size_t>(i % kNoises)]);
  }
  const double counts = kSensorScale * PointSpread::of(1).intensity_of_snr(kSnr);
  for (int i = 0; i < kFrames; ++i) {
    for (int target = 0; target < kTargets; ++target) {
      const double x = (target + 0.5) * width / kTargets + kSpeed * i;
      const double y = ((target * 7) % kTargets + 0.5) * height / kTargets;
      stamp(frames_[static_cast<std::size_t>(i)].view(), x, y, counts);
    }
  }
}

const Image<std::uint16_t>& MemoryScene::frame(std::int64_t index) const {
  constexpr std::int64_t kPeriod = 2 * kFrames - 2;
  const std::int64_t phase = index % kPeriod;
  return frames_[static_cast<std::size_t>(phase < kFrames ? phase : kPeriod - phase)];
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

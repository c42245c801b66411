// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/frames/registered_background.hpp"

#include <algorithm>
#include <utility>

#include "glint/engine/state/fields.hpp"

namespace glint {
namespace {

constexpr int kCoarsest = 32;  // [px] least side of a pyramid's last level

}  // namespace

RegisteredBackground::RegisteredBackground(const FramesConfig& config, const Device& device)
    : device_(device),
      spacing_(std::clamp((config.spatial_window - 1) / 4, 1, SpatialMedian::kMaxSpacing)),
      max_shift_(config.max_shift),
      stride_(config.registered_stride),
      gain_(config.registration_gain),
      slots_(static_cast<std::size_t>(config.registered_frames)) {}

void RegisteredBackground::Pyramid::put_to(ByteWriter& to) const { put_bytes(to, levels.front()); }

void RegisteredBackground::Pyramid::take_from(ByteReader& from) {
  take_bytes(from, levels.emplace_back());
}

void RegisteredBackground::build(FrameView image, Pyramid& pyramid) const {
  if (pyramid.levels.empty()) {
    int width = image.width, height = image.height;
    do {
      pyramid.levels.emplace_back(width, height, device_);
      width /= 2, height /= 2;
    } while (std::min(width, height) >= kCoarsest);
    for (const auto& level : pyramid.levels) pyramid.views.push_back(level.view());
  }
  device_.copy(image, pyramid.levels[0].view());
  for (std::size_t i = 1; i < pyramid.levels.size(); ++i) {
    device_.run<Halve>({pyramid.views[i - 1], pyramid.levels[i].view()});
  }
}

FrameView RegisteredBackground::registered(const Pyramid& sample, ResidentImage<float>& moved) {
  Shift shift;
  device_.run<EstimateShift>({present_.views, sample.views, max_shift_, &shift});
  ++compared_;
  if (!shift.improves(gain_)) return sample.views[0];
  ++shifted_;
  device_.run<ShiftImage>({sample.views[0], shift.dx, shift.dy, moved.view()});
  return moved.view();
}

bool RegisteredBackground::estimate(const BackgroundInput& input, ImageView<float> background) {
  build(input.grey, present_);
  provisional_ = samples_.empty();
  if (provisional_) {
    device_.run<SpatialMedian>({input.grey, spacing_, background});
    return true;
  }
  stack_.clear();
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    stack_.push_back(registered(samples_[i], moved_[i]));
  }
  device_.run<StackMedian>({std::span<const FrameView>(stack_), background});
  return true;
}

void RegisteredBackground::learn(const BackgroundInput& input) {
  if (now_++ % stride_ != 0) return;
  if (samples_.size() < slots_) {
    samples_.emplace_back();
    moved_.emplace_back(input.grey.width, input.grey.height, device_);
  }
  build(input.grey, samples_[next_]);
  next_ = (next_ + 1) % slots_;
}

void RegisteredBackground::save(ByteWriter& to) const { put_bytes(to, *this); }

void RegisteredBackground::restore(ByteReader& from, int width, int height) {
  take_bytes(from, *this);
  require_bytes(samples_.size() <= slots_ && next_ < slots_ &&
                    (samples_.size() == slots_ || next_ == samples_.size()),
                "the background has no such sample");
  require_frame_number(now_), require_frame_number(compared_), require_frame_number(shifted_);
  moved_.clear(), present_ = {};
  for (Pyramid& sample : samples_) {
    const ResidentImage<float> finest = std::move(sample.levels.front());
    require_bytes(finest.width() == width && finest.height() == height && width > 0,
                  "a sample of the background has another size than the frames");
    sample.levels.clear();
    build(finest.view(), sample);
    moved_.emplace_back(width, height, device_);
  }
}

std::string RegisteredBackground::description() const {
  return "background: median of " + std::to_string(samples_.size()) + " registered frames, " +
         std::to_string(shifted_) + " of " + std::to_string(compared_) + " shifts accepted";
}

}  // namespace glint

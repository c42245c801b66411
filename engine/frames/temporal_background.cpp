// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/frames/temporal_background.hpp"

#include <algorithm>

#include "glint/engine/state/fields.hpp"

namespace glint {

TemporalBackground::TemporalBackground(const FramesConfig& config, const Device& device)
    : device_(device),
      spacing_(std::clamp((config.spatial_window - 1) / 4, 1, SpatialMedian::kMaxSpacing)),
      times_(std::clamp(config.background_frames / config.background_stride, 1,
                        static_cast<int>(kMaxStack)),
             config.background_stride) {}

bool TemporalBackground::estimate(const BackgroundInput& input, ImageView<float> background) {
  provisional_ = times_.size() == 0;
  if (provisional_) {
    device_.run<SpatialMedian>({input.grey, spacing_, background});
    return true;
  }
  if (!stale_) return false;
  const auto median = [&](const auto& samples) {
    device_.run<StackMedian>({std::span(samples.views), background});
  };
  std::visit(median, samples_);
  stale_ = false;
  return true;
}

void TemporalBackground::learn(const BackgroundInput& input) {
  const std::int64_t t = now_++;
  if (!times_.due(t)) return;
  if (times_.size() == 0) start(input);
  const auto slot = static_cast<std::size_t>(times_.insert(t));
  if (auto* bytes = std::get_if<Samples<std::uint8_t>>(&samples_)) {
    keep(*bytes, slot, pixels<std::uint8_t>(input.raw));
  } else if (auto* words = std::get_if<Samples<std::uint16_t>>(&samples_)) {
    keep(*words, slot, pixels<std::uint16_t>(input.raw));
  } else {
    keep(std::get<Samples<float>>(samples_), slot, input.grey);
  }
  stale_ = true;
}

void TemporalBackground::save(ByteWriter& to) const { put_bytes(to, *this); }

void TemporalBackground::restore(ByteReader& from, int width, int height) {
  take_bytes(from, *this);
  require_frame_number(now_);
  const auto check = [&](auto& samples) {
    require_bytes(samples.images.size() == static_cast<std::size_t>(times_.size()),
                  "the background lacks a sample");
    for (auto& image : samples.images) {
      require_bytes(image.width() == width && image.height() == height && width > 0,
                    "a sample of the background has another size than the frames");
      image.make_resident(device_);
    }
  };
  std::visit(check, samples_);
}

std::string TemporalBackground::description() const {
  return "background: median of " + std::to_string(times_.size()) + " frames over the last " +
         std::to_string(times_.span() + 1);
}

void TemporalBackground::start(const BackgroundInput& input) {
  if (input.exact && std::holds_alternative<const std::uint8_t*>(input.raw.data)) {
    samples_.emplace<Samples<std::uint8_t>>();
  } else if (input.exact && std::holds_alternative<const std::uint16_t*>(input.raw.data)) {
    samples_.emplace<Samples<std::uint16_t>>();
  } else {
    samples_.emplace<Samples<float>>();
  }
}

template <class T>
ImageView<const T> TemporalBackground::pixels(const RawPixels& raw) {
  return {std::get<const T*>(raw.data), raw.width, raw.height, raw.pitch};
}

template <class T>
void TemporalBackground::keep(Samples<T>& samples, std::size_t slot, ImageView<const T> image) {
  if (slot == samples.images.size()) {
    samples.images.emplace_back(image.width, image.height, device_);
    samples.views.push_back(samples.images.back().view());
  }
  device_.copy(image, samples.images[slot].view());
}

}  // namespace glint

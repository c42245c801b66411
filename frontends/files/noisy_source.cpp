// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/files/noisy_source.hpp"

#include <utility>

#include "glint/kernels/add_noise/add_noise.hpp"
#include "glint/kernels/core/random.hpp"
#include "glint/kernels/prepare_frame/prepare_frame.hpp"

namespace glint {

NoisySource::NoisySource(std::unique_ptr<Source> source, double sigma, std::uint64_t seed,
                         const Device& device)
    : source_(std::move(source)), sigma_(static_cast<float>(sigma)), seed_(seed), device_(device) {}

std::optional<SourceFrame> NoisySource::next() {
  auto frame = source_->next();
  if (!frame) return std::nullopt;
  auto noisy = std::make_shared<Image<float>>(frame->pixels.width, frame->pixels.height);
  const ImageView<float> view = noisy->view();
  device_.run<ToGrey>({.raw = frame->pixels, .grey = view});
  device_.run<AddNoise>({view, sigma_, random_key(seed_, frame_++, Purpose::added_noise)});
  frame->pixels = {static_cast<const float*>(view.data), view.width, view.height, 1, view.pitch};
  frame->owner = std::move(noisy);
  return frame;
}

}  // namespace glint

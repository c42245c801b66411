// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <memory>

#include "glint/kernels/prepare_frame/prepare_frame.hpp"
#include "glint/kernels/prepare_frame/trial_images.hpp"

namespace glint {
namespace {

template <class T>
struct GreyProblem {
  std::vector<T> pixels;
  RawPixels raw;
  Image<float> grey;
  bool masked = false;
};

/// Raw pixels over the whole range of their type, with a pitch wider than the row.
template <class T>
std::shared_ptr<GreyProblem<T>> grey_problem(int width, int height, int channels, bool masked) {
  auto p = std::make_shared<GreyProblem<T>>();
  const int pitch = width * channels + 5;
  p->pixels.resize(static_cast<std::size_t>(pitch) * static_cast<std::size_t>(height));
  const RandomKey key = random_key(3, 0, Purpose::trial);
  for (std::size_t i = 0; i < p->pixels.size(); ++i) {
    const std::uint32_t word = random_words(key, static_cast<std::uint32_t>(i)).w[0];
    p->pixels[i] = static_cast<T>(word & (sizeof(T) == 1 ? 255 : 65535));
    if constexpr (std::is_same_v<T, float>) {
      p->pixels[i] = p->pixels[i] / 100 - 50;
      if (masked && word % 50 == 0) p->pixels[i] = std::numeric_limits<float>::quiet_NaN();
      if (masked && word % 50 == 1) p->pixels[i] = std::numeric_limits<float>::infinity();
      if (masked && word % 50 == 2) p->pixels[i] = std::numeric_limits<float>::lowest();
      if (masked && word % 50 == 3) p->pixels[i] = -1.01f * ToGrey::kLargest;
    }
  }
  p->raw = {static_cast<const T*>(p->pixels.data()), width, height, channels, pitch};
  p->grey = Image<float>(width, height);
  return p;
}

template <class T>
void add_grey(Trials& trials, const char* type, int width, int height, int channels,
              bool reciprocal, bool masked = false) {
  const auto p = grey_problem<T>(width, height, channels, masked);
  trials.push_back(std::make_unique<PreparationTrial>(
      "to_grey " + size_of(width, height) + " " + type + " x" + std::to_string(channels) +
          (reciprocal ? " reciprocal" : "") + (masked ? " masked" : ""),
      [p, reciprocal](const Device& device) {
        device.run<ToGrey>({p->raw, reciprocal, 12, p->grey.view(), &p->masked});
      },
      [p] {
        return std::vector<Output>{{"grey", ToGrey::tolerance, values_of(p->grey.view())},
                                   {"masked", {}, {p->masked ? 1.0 : 0.0}}};
      }));
}

}  // namespace

std::vector<std::unique_ptr<Trial>> prepare_frame_trials() {
  Trials trials;
  for (const auto& [width, height] :
       {std::pair{0, 0}, {1, 1}, {17, 3}, {255, 63}, {256, 64}, {257, 65}, {513, 130}}) {
    for (const int channels : {1, 3, 4}) {
      for (const bool reciprocal : {false, true}) {
        add_grey<std::uint8_t>(trials, "u8", width, height, channels, reciprocal);
        add_grey<std::uint16_t>(trials, "u16", width, height, channels, reciprocal);
        add_grey<float>(trials, "f32", width, height, channels, reciprocal);
      }
      add_grey<float>(trials, "f32", width, height, channels, true, true);
    }
  }
  add_background_trials(trials);
  add_registration_trials(trials);
  add_whiten_trials(trials);
  return trials;
}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <memory>

#include "glint/kernels/prepare_frame/background.hpp"
#include "glint/kernels/prepare_frame/trial_images.hpp"

namespace glint {
namespace {

template <class T>
struct Stack {
  std::vector<Image<T>> images;
  std::vector<ImageView<const T>> views;
  Image<float> median;
};

template <class T>
std::shared_ptr<Stack<T>> stack(int width, int height, int n, std::uint32_t masked) {
  auto s = std::make_shared<Stack<T>>();
  for (int i = 0; i < n; ++i) {
    const Image<float> source =
        scenery(width, height, 10, static_cast<std::uint64_t>(i), masked + (masked > 0 ? i : 0));
    s->images.emplace_back(width, height);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const float value = source.view()(x, y);
        s->images.back().view()(x, y) = std::is_same_v<T, float>
                                            ? static_cast<T>(value)
                                            : static_cast<T>(std::clamp(value, 0.0F, 255.0F));
      }
    }
  }
  for (const auto& image : s->images) s->views.push_back(image.view());
  s->median = Image<float>(width, height);
  return s;
}

template <class T>
void add_stack(Trials& trials, const char* type, int width, int height, int n,
               std::uint32_t masked = 0) {
  const auto s = stack<T>(width, height, n, masked);
  trials.push_back(std::make_unique<PreparationTrial>(
      "stack_median " + size_of(width, height) + " " + type + " of " + std::to_string(n) +
          (masked > 0 ? " masked" : ""),
      [s](const Device& device) {
        device.run<StackMedian>({std::span<const ImageView<const T>>(s->views), s->median.view()});
      },
      [s] {
        return std::vector<Output>{{"median", StackMedian::tolerance, values_of(s->median.view())}};
      }));
}

void add_lattice(Trials& trials, int width, int height, int spacing, std::uint32_t masked) {
  const auto image = std::make_shared<Image<float>>(scenery(width, height, 10, 1, masked));
  const auto median = std::make_shared<Image<float>>(width, height);
  trials.push_back(std::make_unique<PreparationTrial>(
      "spatial_median " + size_of(width, height) + " spacing " + std::to_string(spacing) +
          (masked > 0 ? " masked" : ""),
      [=](const Device& device) {
        device.run<SpatialMedian>({image->view(), spacing, median->view()});
      },
      [=] {
        return std::vector<Output>{{"median", SpatialMedian::tolerance, values_of(median->view())}};
      }));
}

}  // namespace

void add_background_trials(Trials& trials) {
  for (const int n : {1, 2, 3, 4, 7, 15, 16, 31, 64}) {
    add_stack<std::uint8_t>(trials, "u8", 257, 9, n);
    add_stack<std::uint16_t>(trials, "u16", 129, 9, n);
    add_stack<float>(trials, "f32", 65, 9, n);
    add_stack<float>(trials, "f32", 65, 9, n, 3);
  }
  for (const auto& [width, height] : {std::pair{0, 0}, {1, 1}, {63, 31}, {64, 32}, {130, 33}}) {
    add_stack<std::uint8_t>(trials, "u8", width, height, 15);
    add_stack<float>(trials, "f32", width, height, 15, 7);
    for (const int spacing : {1, 4, SpatialMedian::kMaxSpacing}) {
      add_lattice(trials, width, height, spacing, 0);
      add_lattice(trials, width, height, spacing, 2);
    }
  }
}

}  // namespace glint

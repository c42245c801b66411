// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "glint/kernels/prepare_frame/registration.hpp"
#include "glint/kernels/prepare_frame/trial_images.hpp"

namespace glint {
namespace {

struct Pair {
  std::vector<Image<float>> reference, moving;
  std::vector<FrameView> reference_views, moving_views;
  Image<float> moved;
  Shift shift;
};

std::vector<Image<float>> pyramid(Image<float> finest) {
  std::vector<Image<float>> levels;
  levels.push_back(std::move(finest));
  while (std::min(levels.back().width(), levels.back().height()) >= 64) {
    Image<float> half(levels.back().width() / 2, levels.back().height() / 2);
    Halve::serial({levels.back().view(), half.view()});
    levels.push_back(std::move(half));
  }
  return levels;
}

/// One scenery seen twice, the second time moved, with noise of its own.
std::shared_ptr<Pair> pair(int width, int height, double dx, double dy, std::uint32_t masked) {
  auto p = std::make_shared<Pair>();
  Image<float> still = scenery(width, height, 3, 1), moved(width, height);
  ShiftImage::serial({still.view(), dx, dy, moved.view()});
  const Image<float> noise = scenery(width, height, 1, 2, masked);
  const Image<float> quiet = scenery(width, height, 0, 2);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) moved.view()(x, y) += noise.view()(x, y) - quiet.view()(x, y);
  }
  p->reference = pyramid(std::move(moved));
  p->moving = pyramid(std::move(still));
  for (const auto& level : p->reference) p->reference_views.push_back(level.view());
  for (const auto& level : p->moving) p->moving_views.push_back(level.view());
  p->moved = Image<float>(width, height);
  return p;
}

void add_estimate(Trials& trials, int width, int height, double dx, double dy,
                  std::uint32_t masked = 0) {
  const auto p = pair(width, height, dx, dy, masked);
  const std::string text = size_of(width, height) + " by " + std::to_string(dx).substr(0, 5) + "," +
                           std::to_string(dy).substr(0, 5) + (masked > 0 ? " masked" : "");
  trials.push_back(std::make_unique<PreparationTrial>(
      "estimate_shift " + text,
      [p](const Device& device) {
        device.run<EstimateShift>({p->reference_views, p->moving_views, 8, &p->shift});
      },
      [p] {
        const Shift& s = p->shift;
        return std::vector<Output>{
            {"shift", EstimateShift::tolerance, {s.dx, s.dy, s.unshifted, s.shifted}}};
      }));
  trials.push_back(std::make_unique<PreparationTrial>(
      "shift_image " + text,
      [=](const Device& device) {
        device.run<ShiftImage>({p->moving_views[0], dx, dy, p->moved.view()});
      },
      [p] {
        return std::vector<Output>{{"moved", ShiftImage::tolerance, values_of(p->moved.view())}};
      }));
}

void add_halve(Trials& trials, int width, int height) {
  const auto image = std::make_shared<Image<float>>(scenery(width, height, 10, 1, 17));
  const auto half = std::make_shared<Image<float>>(width / 2, height / 2);
  trials.push_back(std::make_unique<PreparationTrial>(
      "halve " + size_of(width, height),
      [=](const Device& device) {
        device.run<Halve>({image->view(), half->view()});
      },
      [=] {
        return std::vector<Output>{{"half", Halve::tolerance, values_of(half->view())}};
      }));
}

}  // namespace

void add_registration_trials(Trials& trials) {
  for (const auto& [width, height] : {std::pair{0, 0}, {1, 1}, {2, 2}, {65, 127}, {130, 131}}) {
    add_halve(trials, width, height);
  }
  for (const auto& [width, height] : {std::pair{40, 33}, {97, 66}, {130, 129}}) {
    add_estimate(trials, width, height, 0, 0);
    add_estimate(trials, width, height, 3, -2);
    add_estimate(trials, width, height, -1.3, 2.6);
    add_estimate(trials, width, height, 0.4, 0.25, 11);
  }
}

}  // namespace glint

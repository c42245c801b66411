// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "glint/kernels/prepare_frame/trial_images.hpp"
#include "glint/kernels/prepare_frame/whiten.hpp"

namespace glint {
namespace {

struct WhitenProblem {
  Image<float> image, background, structure, whitened, noise;
  Whiten::Args args;
};

std::shared_ptr<WhitenProblem> problem(int width, int height, const Whiten::Args& base,
                                       std::uint32_t masked, bool structured) {
  auto p = std::make_shared<WhitenProblem>();
  p->image = scenery(width, height, 2, 1, masked);
  p->background = scenery(width, height, 0.5F, 2, masked > 0 ? masked + 4 : 0);
  p->structure = Image<float>(width, height);
  p->whitened = Image<float>(width, height);
  p->args = base;
  const int step = base.noise_step;
  p->noise = Image<float>((width + step - 1) / step, (height + step - 1) / step);
  BackgroundStructure::serial({p->background.view(), p->structure.view()});
  p->args.image = p->image.view();
  p->args.background = p->background.view();
  if (structured) p->args.structure = p->structure.view();
  p->args.whitened = p->whitened.view();
  p->args.noise = p->noise.view();
  return p;
}

void add_whiten(Trials& trials, int width, int height, const Whiten::Args& base,
                std::uint32_t masked = 0, bool structured = false) {
  const auto p = problem(width, height, base, masked, structured);
  trials.push_back(std::make_unique<PreparationTrial>(
      "whiten " + size_of(width, height) + " ring " + std::to_string(base.ring_outer) + "/" +
          std::to_string(base.ring_inner) + " polarity " +
          std::to_string(static_cast<int>(base.polarity)) + (masked > 0 ? " masked" : "") +
          (structured ? " structured" : ""),
      [p](const Device& device) { device.run<Whiten>(p->args); },
      [p] {
        return std::vector<Output>{{"whitened", Whiten::tolerance, values_of(p->whitened.view())},
                                   {"noise", Whiten::tolerance, values_of(p->noise.view())}};
      }));
}

void add_structure(Trials& trials, int width, int height, std::uint32_t masked) {
  const auto image = std::make_shared<Image<float>>(scenery(width, height, 2, 1, masked));
  const auto structure = std::make_shared<Image<float>>(width, height);
  trials.push_back(std::make_unique<PreparationTrial>(
      "background_structure " + size_of(width, height) + (masked > 0 ? " masked" : ""),
      [=](const Device& device) {
        device.run<BackgroundStructure>({image->view(), structure->view()});
      },
      [=] {
        return std::vector<Output>{
            {"structure", BackgroundStructure::tolerance, values_of(structure->view())}};
      }));
}

struct SpreadProblem {
  Image<float> image, background;
  std::vector<float> workspace;
  Spread spread;
};

void add_spread(Trials& trials, int width, int height, bool background, std::uint32_t masked) {
  const auto p = std::make_shared<SpreadProblem>();
  p->image = scenery(width, height, 2, 1, masked);
  if (background) p->background = scenery(width, height, 0, 2);
  trials.push_back(std::make_unique<PreparationTrial>(
      "robust_spread " + size_of(width, height) + (background ? " less background" : "") +
          (masked > 0 ? " masked" : ""),
      [p](const Device& device) {
        device.run<RobustSpread>(
            {p->image.view(), p->background.view(), &p->workspace, &p->spread});
      },
      [p] {
        return std::vector<Output>{
            {"spread", RobustSpread::tolerance, {p->spread.median, p->spread.sigma}}};
      }));
}

}  // namespace

void add_whiten_trials(Trials& trials) {
  Whiten::Args base;
  base.sigma = 1.5;
  base.ring_outer = 15, base.ring_inner = 5, base.ring_clip = 10;
  base.clip_low = -3, base.clip_high = 8;
  for (const auto& [width, height] :
       {std::pair{0, 0}, {1, 1}, {7, 5}, {33, 63}, {65, 64}, {64, 65}, {1025, 9}}) {
    add_whiten(trials, width, height, base);
    add_whiten(trials, width, height, base, 13, true);
    for (const std::uint32_t masked : {0U, 1U, 2U, 19U}) {
      add_structure(trials, width, height, masked);
      add_spread(trials, width, height, masked != 2, masked);
    }
  }
  add_spread(trials, 301, 199, true, 19);
  base.noise_step = 3;
  for (const auto& [outer, inner] : {std::pair{0, 0}, {1, 0}, {2, 1}, {15, 14}, {31, 5}}) {
    base.ring_outer = outer, base.ring_inner = inner;
    base.polarity = static_cast<Polarity>(outer % 3);
    add_whiten(trials, 45, 37, base, 0, true);
    add_whiten(trials, 45, 37, base, 5);
  }
  base.ring_clip = 1;
  base.clip_high = 2;
  add_whiten(trials, 50, 70, base, 1);
  add_whiten(trials, 50, 70, base);
}

}  // namespace glint

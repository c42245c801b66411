// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "glint/kernels/core/frame.hpp"
#include "glint/kernels/core/random.hpp"
#include "glint/kernels/core/trial.hpp"

namespace glint {

/// A trial out of two functions.
class PreparationTrial : public Trial {
 public:
  PreparationTrial(std::string text, std::function<void(const Device&)> run,
                   std::function<std::vector<Output>()> outputs)
      : text_(std::move(text)), run_(std::move(run)), outputs_(std::move(outputs)) {}
  std::string description() const override { return text_; }
  void run(const Device& device) override { run_(device); }
  std::vector<Output> outputs() const override { return outputs_(); }

 private:
  std::string text_;
  std::function<void(const Device&)> run_;
  std::function<std::vector<Output>()> outputs_;
};

using Trials = std::vector<std::unique_ptr<Trial>>;

inline std::vector<double> values_of(FrameView image) {
  std::vector<double> values;
  for (int y = 0; y < image.height; ++y) {
    values.insert(values.end(), image.row(y), image.row(y) + image.width);
  }
  return values;
}

inline std::string size_of(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

/// Noise of standard deviation `noise` on smooth hills and one sharp edge; every `masked`-th pixel
/// is NaN (0: none).
inline Image<float> scenery(int width, int height, float noise, std::uint64_t seed,
                            std::uint32_t masked = 0) {
  Image<float> image(width, height);
  const RandomKey key = random_key(seed, 0, Purpose::trial);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto item = static_cast<std::uint32_t>(y * width + x);
      const float hills = 60 + 20 * std::sin(0.11F * static_cast<float>(x)) *
                                   std::cos(0.07F * static_cast<float>(y));
      const float edge = 3 * x > 2 * width ? 40.0F : 0.0F;
      const bool hidden = masked != 0 && item % masked == masked / 2;
      image.view()(x, y) = hidden ? std::numeric_limits<float>::quiet_NaN()
                                  : hills + edge + noise * random_normals(key, item).n[0];
    }
  }
  return image;
}

void add_background_trials(Trials& trials);
void add_registration_trials(Trials& trials);
void add_whiten_trials(Trials& trials);

}  // namespace glint

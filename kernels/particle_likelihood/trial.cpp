// SPDX-License-Identifier: Apache-2.0
#include <limits>
#include <string>

#include "glint/kernels/core/aligned.hpp"
#include "glint/kernels/core/device.hpp"
#include "glint/kernels/core/random.hpp"
#include "glint/kernels/particle_likelihood/particle_likelihood.hpp"

namespace glint {
namespace {

struct Problem {
  std::size_t particles;
  double sigma = 0.7;
  float jitter = 0;
  int width = 73, height = 41;
};

Image<float> noise_frame(int width, int height) {
  Image<float> frame(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto item = static_cast<std::uint32_t>(y * width + x);
      frame.view()(x, y) = random_normals(random_key(1, 0, Purpose::trial), item).n[0];
    }
  }
  return frame;
}

/// Particles all over the frame, some beside it, some on its edge, some on the edge between two
/// pixels, some that are no numbers.
class ParticleTrial : public Trial {
 public:
  explicit ParticleTrial(const Problem& p)
      : problem_(p), frame_(noise_frame(p.width, p.height)), out_(p.particles) {
    const auto width = static_cast<float>(p.width), height = static_cast<float>(p.height);
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const float odd[] = {-0.5f,
                         0.5f,
                         1.5f,
                         width - 0.5f,
                         width - 1.5f,
                         height - 0.5f,
                         height - 1.5f,
                         0.49999997f,
                         -0.50000006f,
                         0,
                         kInfinity,
                         -kInfinity,
                         1e30f,
                         3e9f,
                         std::numeric_limits<float>::quiet_NaN()};
    constexpr std::size_t kOdd = std::size(odd);
    for (std::size_t i = 0; i < p.particles; ++i) {
      const Words4 u =
          random_words(random_key(2, 0, Purpose::trial), static_cast<std::uint32_t>(i));
      x_.push_back((width + 4) * uniform(u.w[0]) - 2.5f);
      y_.push_back((height + 4) * uniform(u.w[1]) - 2.5f);
      intensity_.push_back(8 + 12 * uniform(u.w[2]));
      if (i % 11 == 3) x_[i] = odd[i / 11 % kOdd];
      if (i % 13 == 5) y_[i] = odd[i / 13 % kOdd];
      if (i % 97 == 7) intensity_[i] = odd[kOdd - 1 - i / 97 % 5];
    }
  }

  std::string description() const override {
    const int window = PointSpread::of(problem_.sigma).width();
    return std::to_string(problem_.particles) + " particles " + std::to_string(window) + "x" +
           std::to_string(window) + " in " + std::to_string(problem_.width) + "x" +
           std::to_string(problem_.height) + (problem_.jitter > 0 ? " jitter" : "");
  }
  void run(const Device& device) override {
    device.run<ParticleLikelihood>({.frame = frame_.view(),
                                    .spread = PointSpread::of(problem_.sigma),
                                    .x = x_,
                                    .y = y_,
                                    .intensity = intensity_,
                                    .log_ratio = out_,
                                    .jitter = problem_.jitter,
                                    .key = random_key(3, 7, Purpose::jitter)});
  }
  std::vector<Output> outputs() const override {
    return {{"log ratio", ParticleLikelihood::tolerance, {out_.begin(), out_.end()}}};
  }

 private:
  Problem problem_;
  Image<float> frame_;
  AlignedVector<float> x_, y_, intensity_, out_;
};

}  // namespace

std::vector<std::unique_ptr<Trial>> ParticleLikelihood::trials() {
  const Problem problems[] = {
      {0},
      {1},
      {7, 0.6},
      {63},
      {64, 1.0},
      {65, 0.7, 0.2f},
      {4095},
      {4096, 0.6},
      {4097, 1.0},
      {20001},
      {5000, 1.0, 0.5f},
      {5000, 0.4},                    // a polynomial with more terms
      {3000, 0.3},                    // 1x1
      {3000, 0.15},                   // no polynomial
      {3000, 1.4},                    // 9x9: two vectors a row
      {3000, 2.6},                    // 15x15
      {3000, 1.0, 0, 3, 2},           // smaller than the window
      {500, 0.7, 0, 1, 1},            //
      {70, 0.7, 0, 0, 0},             //
      {5000, 0.7, 0, 131, 300},       // spread over enough rows to be asked for ahead
      {140001, 0.7, 0.2f, 301, 470},  // more than small buffers of a device hold
  };
  std::vector<std::unique_ptr<Trial>> all;
  for (const Problem& problem : problems) all.push_back(std::make_unique<ParticleTrial>(problem));
  return all;
}

}  // namespace glint

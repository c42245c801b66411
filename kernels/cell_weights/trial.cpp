// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <limits>
#include <string>

#include "glint/kernels/cell_weights/cell_weights.hpp"
#include "glint/kernels/core/random.hpp"

namespace glint {
namespace {

struct Problem {
  std::size_t particles;
  int width, height, half_width;
  Psi psi = Psi::window;
  float clutter = 1;
  float spread = 1.5f;  ///< of the clouds [px]; 0 = all over the frame and past its border
};

class CellWeightsTrial : public Trial {
 public:
  explicit CellWeightsTrial(const Problem& problem) : problem_(problem) {
    for (auto* array : {&x_, &y_, &predicted_, &log_ratio_, &updated_, &weighted_}) {
      array->resize(problem.particles);
    }
    for (std::size_t i = 0; i < problem.particles; ++i) set(i);
  }

  std::string description() const override {
    return std::to_string(problem_.particles) + " particles, " + std::to_string(problem_.width) +
           "x" + std::to_string(problem_.height) +
           (problem_.psi == Psi::window ? ", window " + std::to_string(2 * problem_.half_width + 1)
                                        : ", single cells") +
           (problem_.spread > 0 ? ", clouds" : ", spread") +
           (problem_.clutter > 0 ? "" : ", no clutter");
  }
  void run(const Device& device) override {
    device.run<CellWeights>({.width = problem_.width,
                             .height = problem_.height,
                             .half_width = problem_.half_width,
                             .psi = problem_.psi,
                             .clutter = problem_.clutter,
                             .x = x_,
                             .y = y_,
                             .predicted = predicted_,
                             .log_ratio = log_ratio_,
                             .updated = updated_,
                             .weighted = weighted_,
                             .workspace = &workspace_});
  }
  std::vector<Output> outputs() const override {
    const auto list = [](const auto& values) {
      return std::vector<double>(values.begin(), values.end());
    };
    const CellRuns& runs = workspace_.runs;
    return {{"updated", CellWeights::tolerance, list(updated_)},
            {"weighted", CellWeights::tolerance, list(weighted_)},
            {"order", {}, list(runs.order)},
            {"cell", {}, list(runs.cell)},
            {"first", {}, list(runs.first)},
            {"mass", CellWeights::tolerance, list(runs.mass)},
            {"cell_sum", CellWeights::tolerance, list(workspace_.cell_sum)},
            {"box_sum", CellWeights::tolerance, list(workspace_.box_sum)}};
  }

 private:
  void set(std::size_t i) {
    const auto item = static_cast<std::uint32_t>(i);
    const RandomKey key = random_key(7, 0, Purpose::trial);
    const Words4 words = random_words(key, problem_.spread > 0 ? item % 5 : item, 1);
    const Normals4 normals = random_normals(key, item);
    const auto width = static_cast<float>(problem_.width);
    const auto height = static_cast<float>(problem_.height);
    const float margin = problem_.spread > 0 ? 0.0f : 1.0f;
    x_[i] =
        uniform(words.w[0]) * (width + 2 * margin) - margin - 0.5f + problem_.spread * normals.n[0];
    y_[i] = uniform(words.w[1]) * (height + 2 * margin) - margin - 0.5f +
            problem_.spread * normals.n[1];
    predicted_[i] = 1e-3f * (1 + uniform(words.w[2]));
    log_ratio_[i] = 2 + 3 * normals.n[2];
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    if (i % 97 == 5) x_[i] = std::array{kNan, kInfinity, -kInfinity, -0.5f, width - 0.5f}[i % 5];
    if (i % 89 == 3) log_ratio_[i] = std::array{kNan, -kInfinity, kInfinity, 1e6f}[i % 4];
  }

  Problem problem_;
  std::vector<float> x_, y_, predicted_, log_ratio_, updated_, weighted_;
  CellWorkspace workspace_;
};

}  // namespace

std::vector<std::unique_ptr<Trial>> CellWeights::trials() {
  std::vector<std::unique_ptr<Trial>> list;
  const auto add = [&](const Problem& p) { list.push_back(std::make_unique<CellWeightsTrial>(p)); };
  for (const std::size_t n : {0u, 1u, 15u, 4095u, 4096u, 4097u}) add({n, 61, 43, 2});
  add({5000, 61, 43, 1, Psi::cell});
  add({5000, 1, 1, 2});
  add({5000, 3, 5, 7});
  add({20001, 641, 67, 2, Psi::window, 0});
  add({30001, 301, 211, 3, Psi::window, 1, 0});
  add({70001, 4096, 4096, 2});
  return list;
}

}  // namespace glint

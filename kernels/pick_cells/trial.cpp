// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "glint/kernels/core/random.hpp"
#include "glint/kernels/pick_cells/pick_cells.hpp"

namespace glint {
namespace {

struct Problem {
  int width, height, reach;
  std::size_t cells;
};

class PickCellsTrial : public Trial {
 public:
  explicit PickCellsTrial(const Problem& problem)
      : problem_(problem), score_(problem.width, problem.height) {
    const RandomKey key = random_key(5, 0, Purpose::trial);
    const auto pixels = static_cast<std::uint32_t>(problem.width * problem.height);
    for (std::uint32_t i = 0; i < pixels; ++i) {
      const auto width = static_cast<std::uint32_t>(problem.width);
      const float u = uniform(random_words(key, i, 1).w[0]);
      score_.view()(static_cast<int>(i % width), static_cast<int>(i / width)) =
          i % 7 == 3 ? 0 : u * u * u * 100;
    }
    for (std::uint32_t i = 0; i < problem.cells; ++i) {
      const Words4 words = random_words(key, i, 2);
      // Corners, too.
      cell_.push_back(i == 0 ? 0 : i == 1 ? pixels - 1 : words.w[0] % pixels);
      uniform_.push_back(uniform(words.w[1]));
    }
    picked_.resize(problem.cells), picked_score_.resize(problem.cells);
    total_.resize(problem.cells);
  }
  std::string description() const override {
    return std::to_string(problem_.cells) + " cells of " + std::to_string(problem_.width) + "x" +
           std::to_string(problem_.height) + ", reach " + std::to_string(problem_.reach);
  }
  void run(const Device& device) override {
    device.run<PickCells>(
        {score_.view(), problem_.reach, cell_, uniform_, picked_, picked_score_, total_});
  }
  std::vector<Output> outputs() const override {
    return {{"picked", {}, {picked_.begin(), picked_.end()}},
            {"picked_score", {}, {picked_score_.begin(), picked_score_.end()}},
            {"total", PickCells::tolerance, total_}};
  }

 private:
  Problem problem_;
  Image<float> score_;
  std::vector<std::uint32_t> cell_, picked_;
  std::vector<float> uniform_, picked_score_;
  std::vector<double> total_;
};

}  // namespace

std::vector<std::unique_ptr<Trial>> PickCells::trials() {
  std::vector<std::unique_ptr<Trial>> all;
  for (const Problem& problem : {Problem{1, 1, 0, 1},
                                 {1, 1, 3, 2},
                                 {5, 3, 0, 40},
                                 {17, 63, 4, 0},
                                 {64, 64, 4, 511},
                                 {101, 65, 9, 513},
                                 {640, 400, 4, 4000}}) {
    all.push_back(std::make_unique<PickCellsTrial>(problem));
  }
  return all;
}

}  // namespace glint

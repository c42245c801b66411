// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "glint/kernels/core/random.hpp"
#include "glint/kernels/dp_stage/dp_stage.hpp"

namespace glint {
namespace {

struct Problem {
  int width, height, reach = 3, tolerance = 2;
  bool ties = false;  // scores of few values
};

/// Three stages: from scores, with any move, with moves to follow.
class DpStageTrial : public Trial {
 public:
  explicit DpStageTrial(const Problem& p) : problem_(p) {
    for (std::uint32_t k = 0; k < kStages; ++k) {
      score_[k] = Image<float>(p.width, p.height);
      total_[k] = score_[k];
      dx_[k] = dy_[k] = Image<std::int8_t>(p.width, p.height);
      for (int y = 0; y < p.height; ++y) {
        for (int x = 0; x < p.width; ++x) {
          const auto item = static_cast<std::uint32_t>(y * p.width + x);
          const float u = uniform(random_words(random_key(1, k, Purpose::trial), item).w[0]);
          score_[k].view()(x, y) = p.ties ? static_cast<float>(static_cast<int>(3 * u)) : 9 * u - 6;
        }
      }
    }
  }
  std::string description() const override {
    return std::to_string(problem_.width) + "x" + std::to_string(problem_.height) + ", reach " +
           std::to_string(problem_.reach) + ", tolerance " + std::to_string(problem_.tolerance) +
           (problem_.ties ? ", ties" : "");
  }
  void run(const Device& device) override {
    for (std::size_t k = 1; k < kStages; ++k) {
      DpStage::Args a;
      a.score = score_[k].view();
      a.before = k == 1 ? score_[0].view() : total_[k - 1].view();
      if (k > 1) a.moves = {dx_[k - 1].view(), dy_[k - 1].view()};
      a.reach = problem_.reach, a.tolerance = problem_.tolerance;
      a.total = total_[k].view(), a.dx = dx_[k].view(), a.dy = dy_[k].view();
      device.run<DpStage>(a);
    }
  }
  std::vector<Output> outputs() const override {
    std::vector<Output> out{{"total", DpStage::tolerance, {}},
                            {"dx", DpStage::tolerance, {}},
                            {"dy", DpStage::tolerance, {}}};
    for (std::size_t k = 1; k < kStages; ++k) {
      for (int y = 0; y < problem_.height; ++y) {
        for (int x = 0; x < problem_.width; ++x) {
          out[0].values.push_back(total_[k].view()(x, y));
          out[1].values.push_back(dx_[k].view()(x, y));
          out[2].values.push_back(dy_[k].view()(x, y));
        }
      }
    }
    return out;
  }

 private:
  static constexpr std::size_t kStages = 4;
  Problem problem_;
  Image<float> score_[kStages], total_[kStages];
  Image<std::int8_t> dx_[kStages], dy_[kStages];
};

}  // namespace

std::vector<std::unique_ptr<Trial>> DpStage::trials() {
  std::vector<std::unique_ptr<Trial>> all;
  for (const Problem& p : {Problem{0, 0},
                           {1, 1},
                           {3, 2},
                           {16, 7},
                           {22, 8},
                           {23, 9},
                           {101, 65},
                           {513, 70},
                           {1031, 9, 2, 1},
                           {50, 40, 7, 3},
                           {101, 65, 8, 2},
                           {41, 33, 0, 0},
                           {41, 33, 1, 0},
                           {65, 40, 9, 3},
                           {15, 20, kMaxDpReach, 60},
                           {67, 41, 3, 2, true},
                           {67, 41, 3, 0, true}}) {
    all.push_back(std::make_unique<DpStageTrial>(p));
  }
  return all;
}

}  // namespace glint

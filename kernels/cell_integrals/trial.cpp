// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "glint/kernels/cell_integrals/cell_integrals.hpp"
#include "glint/kernels/core/random.hpp"

namespace glint {
namespace {

struct Problem {
  int width, height;
  std::size_t targets;
  double sigma_low = 0.8, sigma_high = 1.4;
  CellRule rule = {};
  const char* mode = "";
};

const Box kMissing[] = {{20, 10, 45, 30}, {-5, 40, 30, 60}, {25, 20, 60, 44}};

class CellIntegralsTrial : public Trial {
 public:
  explicit CellIntegralsTrial(const Problem& problem)
      : problem_(problem), frame_(problem.width, problem.height), sums_(problem.targets) {
    const RandomKey key = random_key(1, 0, Purpose::trial);
    for (int y = 0; y < problem.height; ++y) {
      for (int x = 0; x < problem.width; ++x) {
        const auto item = static_cast<std::uint32_t>(y * problem.width + x);
        frame_.view()(x, y) = -math::log(uniform(random_words(key, item).w[0]));
      }
    }
    // Some lie outside the frame.
    for (std::uint32_t k = 0; k < problem.targets; ++k) {
      const Words4 r = random_words(key, k, 1), s = random_words(key, k, 2);
      const double range = problem.sigma_high - problem.sigma_low;
      targets_.push_back({uniform(r.w[0]) * (problem.width + 12.0) - 6.5,
                          uniform(r.w[1]) * (problem.height + 12.0) - 6.5,
                          problem.sigma_low + range * uniform(r.w[2]),
                          problem.sigma_low + range * uniform(r.w[3]),
                          0.5 * uniform(s.w[0]) / static_cast<double>(problem.targets)});
    }
  }
  std::string description() const override {
    return std::to_string(problem_.width) + "x" + std::to_string(problem_.height) + ", " +
           std::to_string(problem_.targets) + " targets of sigma " +
           std::to_string(problem_.sigma_high).substr(0, 4) + problem_.mode;
  }
  void run(const Device& device) override {
    device.run<SumCells>({frame_.view(), problem_.rule, &total_});
    CellIntegrals::Args args;
    args.frame = frame_.view();
    args.rule = problem_.rule;
    args.total = total_;
    args.background = 0.6;
    args.targets = targets_, args.sums = sums_;
    args.mixture = &mixture_;
    args.workspace = &workspace_;
    device.run<CellIntegrals>(args);
    plain_ = sums_;
    args.log_likelihood = true;
    device.run<CellIntegrals>(args);
  }
  std::vector<Output> outputs() const override {
    std::vector<Output> out{{"frame", SumCells::tolerance, {total_.norm, total_.shown}},
                            {"mixture",
                             CellIntegrals::tolerance,
                             {mixture_.background, mixture_.shown, mixture_.log_likelihood}},
                            {"count", CellIntegrals::tolerance, {}},
                            {"mean", CellIntegrals::mean_tolerance, {}},
                            {"second moment", CellIntegrals::tolerance, {}},
                            {"shown", CellIntegrals::tolerance, {}}};
    for (const std::vector<TargetSums>* sums : {&plain_, &sums_}) {
      for (const TargetSums& s : *sums) {
        out[2].values.push_back(s.count);
        out[3].values.insert(out[3].values.end(), {s.x, s.y});
        out[4].values.insert(out[4].values.end(), {s.xx, s.yy});
        out[5].values.push_back(s.shown);
      }
    }
    return out;
  }

 private:
  Problem problem_;
  Image<float> frame_;
  std::vector<HistogramTarget> targets_;
  std::vector<TargetSums> sums_, plain_;
  CellTotal total_;
  MixtureSums mixture_;
  IntegralsWorkspace workspace_;
};

}  // namespace

std::vector<std::unique_ptr<Trial>> CellIntegrals::trials() {
  std::vector<std::unique_ptr<Trial>> all;
  const auto add = [&](const Problem& p) {
    all.push_back(std::make_unique<CellIntegralsTrial>(p));
  };
  add({0, 0, 0});
  add({1, 1, 1});
  add({16, 15, 3});
  add({200, 200, 1});
  for (const std::size_t targets : {63, 64, 65}) add({301, 203, targets});
  add({97, 65, 40, 0.3, 0.9});
  add({97, 65, 12, 1.4, 3.2});
  add({255, 130, 5, 8, 20});
  add({641, 640, 300, 0.5, 4});
  const CellRule strong{.threshold = 1};
  CellRule subtracted{.threshold = 1, .subtract = true}, truncated{.truncate_dark = true};
  truncated.threshold = 0.5f;
  CellRule boxed;
  boxed.missing = kMissing;
  add({97, 65, 20, 0.8, 1.4, strong, ", threshold"});
  add({97, 65, 20, 0.8, 1.4, subtracted, ", threshold subtracted"});
  add({97, 65, 20, 0.8, 3, truncated, ", dark cells truncated"});
  add({97, 65, 20, 0.8, 3, boxed, ", boxes without data"});
  return all;
}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>
#include <string>

#include "glint/kernels/resample/resample.hpp"

namespace glint {
namespace {

enum class Weights { broad, one, few, peaked, zero, invalid, tiny };

struct Problem {
  std::size_t particles, offspring;
  Weights weights;
  Resampling method;
};

std::string name_of(Weights weights) {
  switch (weights) {
    case Weights::broad:
      return "broad";
    case Weights::one:
      return "one heavy";
    case Weights::few:
      return "few";
    case Weights::peaked:
      return "peaked";
    case Weights::zero:
      return "all zero";
    case Weights::invalid:
      return "some invalid";
    case Weights::tiny:
      return "denormal";
  }
  return {};
}

float weight_of(const Problem& p, std::size_t i) {
  const RandomKey key = random_key(3, 0, Purpose::trial);
  const float u = uniform(random_words(key, static_cast<std::uint32_t>(i)).w[0]);
  const float broad = std::log(u) * std::log(u);
  switch (p.weights) {
    case Weights::broad:
      return broad;
    case Weights::one:
      return i == p.particles / 3 ? 1e6f : 1e-6f * broad;
    case Weights::few:
      return i % 1009 == 5 ? broad : 0.0f;
    case Weights::peaked:
      return i / 4096 % 5 == 2 ? broad : 1e-4f * broad;
    case Weights::zero:
      return 0;
    case Weights::invalid:
      return i % 3 == 0   ? std::numeric_limits<float>::quiet_NaN()
             : i % 3 == 1 ? -broad
             : i == 4001  ? std::numeric_limits<float>::infinity()
                          : broad * 1e37f;
    case Weights::tiny:
      return broad * 1e-43f;
  }
  return 0;
}

class ResampleTrial : public Trial {
 public:
  explicit ResampleTrial(const Problem& problem) : problem_(problem) {
    weights_.resize(problem.particles);
    source_.resize(problem.particles);
    for (std::size_t i = 0; i < problem.particles; ++i) {
      weights_[i] = weight_of(problem, i);
      source_[i] = static_cast<float>(i) + 0.5f;
    }
    ancestors_.resize(problem.offspring);
    for (auto& array : moved_) array.resize(problem.offspring);
  }

  std::string description() const override {
    return std::to_string(problem_.particles) + " to " + std::to_string(problem_.offspring) +
           (problem_.method == Resampling::systematic ? ", systematic, " : ", residual, ") +
           name_of(problem_.weights);
  }
  void run(const Device& device) override {
    const MovedArray moved[] = {{source_.data(), moved_[0].data()},
                                {weights_.data(), moved_[1].data()}};
    device.run<Resample>({.weights = weights_,
                          .ancestors = ancestors_,
                          .method = problem_.method,
                          .key = random_key(5, 9, Purpose::resample),
                          .moved = moved,
                          .workspace = &workspace_});
  }
  std::vector<Output> outputs() const override {
    return {{"ancestors", Resample::tolerance, {ancestors_.begin(), ancestors_.end()}},
            {"moved indices", Resample::tolerance, {moved_[0].begin(), moved_[0].end()}},
            {"moved weights", Resample::tolerance, {moved_[1].begin(), moved_[1].end()}}};
  }

 private:
  Problem problem_;
  std::vector<float> weights_, source_, moved_[2];
  std::vector<std::uint32_t> ancestors_;
  ResampleWorkspace workspace_;
};

}  // namespace

std::vector<std::unique_ptr<Trial>> Resample::trials() {
  std::vector<std::unique_ptr<Trial>> list;
  for (const Resampling method : {Resampling::systematic, Resampling::residual}) {
    const auto add = [&](std::size_t particles, std::size_t offspring, Weights weights) {
      list.push_back(
          std::make_unique<ResampleTrial>(Problem{particles, offspring, weights, method}));
    };
    for (const std::size_t n : {1u, 511u, 513u, 4095u, 4096u, 4097u}) add(n, n, Weights::broad);
    add(0, 0, Weights::broad);
    add(100, 0, Weights::broad);
    add(1, 9001, Weights::broad);
    add(40001, 999, Weights::broad);
    add(997, 40001, Weights::peaked);
    add(50001, 50001, Weights::one);
    add(50001, 30001, Weights::few);
    add(50001, 50001, Weights::peaked);
    add(9001, 9001, Weights::zero);
    add(9001, 8001, Weights::invalid);
    add(9001, 9001, Weights::tiny);
  }
  return list;
}

}  // namespace glint

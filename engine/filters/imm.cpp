// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/filters/imm.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>

namespace glint {
namespace {

using Weights = std::array<double, ModeProbability::kCapacity>;

template <class To>
Belief<To> seen_as(const AnyMode& mode, const Belief<To>& own) {
  return std::visit(
      [&]<class From>(const Mode<From>& from) { return embed<To, From>(from.belief, own); }, mode);
}

/// Mean and covariance of the mixture of `modes`, in the parts of the model `To`.
template <class To>
Belief<To> mixture(const std::vector<AnyMode>& modes, const Weights& weights,
                   const Belief<To>& own) {
  Belief<To> result;
  result.mean.setZero(), result.covariance.setZero();
  for (std::size_t i = 0; i < modes.size(); ++i) {
    result.mean += weights[i] * seen_as<To>(modes[i], own).mean;
  }
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const Belief<To> part = seen_as<To>(modes[i], own);
    const auto off = (part.mean - result.mean).eval();
    result.covariance += weights[i] * (part.covariance + off * off.transpose());
  }
  symmetrise(result.covariance);
  return result;
}

}  // namespace

Imm::Imm(std::vector<AnyMode> modes, const Switching& switching, const ModeProbability& probability)
    : modes_(std::move(modes)), switching_(switching), probability_(probability) {
  const auto count = static_cast<Eigen::Index>(modes_.size());
  if (count == 0 || modes_.size() > ModeProbability::kCapacity || switching.rows() != count ||
      switching.cols() != count || probability.size() != modes_.size()) {
    throw std::invalid_argument(
        "a bank needs one row, column and probability for each of its models");
  }
  if (!(switching.minCoeff() >= 0) || !(switching.rowwise().sum().minCoeff() > 0)) {
    throw std::invalid_argument("switching probabilities must be positive, and no row zero");
  }
  for (Eigen::Index i = 0; i < count; ++i) switching_.row(i) /= switching_.row(i).sum();
}

void Imm::mix() {
  before_ = modes_;
  const ModeProbability from = probability_;
  for (std::size_t j = 0; j < modes_.size(); ++j) {
    Weights weights{};
    double sum = 0;
    for (std::size_t i = 0; i < modes_.size(); ++i) {
      weights[i] = switching_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) * from[i];
      sum += weights[i];
    }
    probability_[j] = sum;
    if (sum == 0) continue;  // a model that nothing leads to goes on as it was
    for (double& w : weights) w /= sum;
    std::visit(
        [&]<class To>(Mode<To>& to) { to.belief = mixture<To>(before_, weights, to.belief); },
        modes_[j]);
  }
}

void Imm::predict(double step) {
  for (AnyMode& any : modes_) {
    std::visit([step](auto& mode) { glint::predict(mode.model, mode.belief, step); }, any);
  }
}

void Imm::weigh(std::span<const double> log_likelihood) {
  const double largest = *std::max_element(log_likelihood.begin(), log_likelihood.end());
  if (!std::isfinite(largest)) return;
  double sum = 0;
  ModeProbability next = probability_;
  for (std::size_t j = 0; j < next.size(); ++j) {
    next[j] *= std::exp(log_likelihood[j] - largest);
    sum += next[j];
  }
  if (!(sum > 0)) return;
  for (double& p : next) p /= sum;
  probability_ = next;
}

Gaussian<4> Imm::combined() const {
  Weights weights{};
  std::copy(probability_.begin(), probability_.end(), weights.begin());
  return mixture<ConstantVelocity>(modes_, weights, {});
}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
// The members of ImmOf, for the one unit of each number of axes that instantiates them.
#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <variant>

#include "glint/engine/filters/imm.hpp"
#include "glint/engine/state/bytes.hpp"

namespace glint {
namespace imm {

using Weights = std::array<double, kMostModes>;

template <int Axes, int N>
Gaussian<N> seen_as(const ModeOf<Axes>& mode, const Gaussian<N>& own) {
  return std::visit([&](const auto& from) { return embed<Axes>(from.belief, own); }, mode);
}

/// Mean and covariance of the mixture of `modes`, in the parts that `own` has.
template <int Axes, int N>
Gaussian<N> mixture(const typename ImmOf<Axes>::Modes& modes, const Weights& weights,
                    const Gaussian<N>& own) {
  Gaussian<N> result;
  result.mean.setZero(), result.covariance.setZero();
  for (std::size_t i = 0; i < modes.size(); ++i) {
    result.mean += weights[i] * seen_as<Axes>(modes[i], own).mean;
  }
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const Gaussian<N> part = seen_as<Axes>(modes[i], own);
    const auto off = (part.mean - result.mean).eval();
    result.covariance += weights[i] * (part.covariance + off * off.transpose());
  }
  symmetrise(result.covariance);
  return result;
}

}  // namespace imm

template <int Axes>
ImmOf<Axes>::ImmOf(const Modes& modes, const Switching& switching,
                   const ModeProbability& probability)
    : probability_(probability), switching_(switching), modes_(modes) {
  const auto count = static_cast<Eigen::Index>(modes_.size());
  if (count == 0 || switching.rows() != count || switching.cols() != count ||
      probability.size() != modes_.size()) {
    throw std::invalid_argument(
        "a bank needs one row, column and probability for each of its models");
  }
  normalise_rows(switching_);
}

template <int Axes>
void ImmOf<Axes>::mix() {
  const Modes before = modes_;
  const ModeProbability from = probability_;
  for (std::size_t j = 0; j < modes_.size(); ++j) {
    imm::Weights weights{};
    double sum = 0;
    for (std::size_t i = 0; i < modes_.size(); ++i) {
      weights[i] = switching_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) * from[i];
      sum += weights[i];
    }
    probability_[j] = sum;
    if (sum == 0) continue;  // a model that nothing leads to goes on as it was
    for (double& w : weights) w /= sum;
    std::visit([&](auto& to) { to.belief = imm::mixture<Axes>(before, weights, to.belief); },
               modes_[j]);
  }
}

template <int Axes>
void ImmOf<Axes>::predict(double step) {
  for (ModeOf<Axes>& any : modes_) {
    std::visit([step](auto& mode) { glint::predict(mode.model, mode.belief, step); }, any);
  }
}

template <int Axes>
Gaussian<2 * Axes> ImmOf<Axes>::combined() const {
  imm::Weights weights{};
  std::copy(probability_.begin(), probability_.end(), weights.begin());
  return imm::mixture<Axes>(modes_, weights, Gaussian<2 * Axes>{});
}

template <int Axes>
bool ImmOf<Axes>::alike(const ImmOf& other) const {
  return std::ranges::equal(
      modes_, other.modes_, {}, [](const auto& mode) { return mode.index(); },
      [](const auto& mode) { return mode.index(); });
}

template <int Axes>
void ImmOf<Axes>::restored() const {
  const auto count = static_cast<Eigen::Index>(modes_.size());
  require_bytes(count > 0 && probability_.size() == modes_.size() && switching_.rows() == count &&
                    switching_.cols() == count,
                "a bank of motion models is not whole");
  require_bytes(switching_.allFinite() &&
                    std::ranges::all_of(probability_, [](double p) { return p >= 0 && p <= 2; }),
                "a probability is none");
}

}  // namespace glint

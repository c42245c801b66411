// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <span>
#include <type_traits>
#include <variant>

#include "glint/engine/filters/imm.hpp"

namespace glint {

/// What the model of a bank believes, which has N numbers.
template <int N, int Axes>
const Gaussian<N>& belief_of(const ModeOf<Axes>& any) {
  return *std::visit(
      [](const auto& mode) -> const Gaussian<N>* {
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(mode.belief)>, Gaussian<N>>) {
          return &mode.belief;
        } else {
          return nullptr;
        }
      },
      any);
}

/// Moments of what model number `mode` of the banks believes; `share` of each, together 1.
template <int N, int Axes, class Share>
Gaussian<N> mixed_belief(std::span<const ImmOf<Axes>> banks, std::size_t mode, const Share& share) {
  Gaussian<N> mixed;
  mixed.mean.setZero(), mixed.covariance.setZero();
  for (std::size_t i = 0; i < banks.size(); ++i) {
    if (share(i) > 0) mixed.mean += share(i) * belief_of<N, Axes>(banks[i].modes()[mode]).mean;
  }
  for (std::size_t i = 0; i < banks.size(); ++i) {
    if (!(share(i) > 0)) continue;
    const Gaussian<N>& part = belief_of<N, Axes>(banks[i].modes()[mode]);
    const Eigen::Matrix<double, N, 1> off = part.mean - mixed.mean;
    mixed.covariance += share(i) * (part.covariance + off * off.transpose());
  }
  symmetrise(mixed.covariance);
  return mixed;
}

/// One bank in place of several of the same models, by moments: of each model the mixture of what
/// the banks believe, weighted by `weights`, which sum to 1, and the model's probability in each.
/// A model that is nowhere likely stays as `into` has it. `into` is none of the banks.
template <int Axes>
void mix_banks(std::span<const ImmOf<Axes>> banks, std::span<const double> weights,
               ImmOf<Axes>& into) {
  ModeProbability probability = into.probability();
  for (std::size_t j = 0; j < into.modes().size(); ++j) {
    const auto weight = [&](std::size_t i) { return weights[i] * banks[i].probability()[j]; };
    double sum = 0;
    for (std::size_t i = 0; i < banks.size(); ++i) sum += weight(i);
    probability[j] = sum;
    if (!(sum > 0)) continue;
    std::visit(
        [&]<class Model>(Mode<Model, Axes>& mode) {
          mode.belief = mixed_belief<Axes * Model::kParts, Axes>(
              banks, j, [&](std::size_t i) { return weight(i) / sum; });
        },
        into.modes()[j]);
  }
  into.set_probability(probability);
}

}  // namespace glint

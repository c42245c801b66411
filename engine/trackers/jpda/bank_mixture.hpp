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

/// What a part of a mixture believes in a model of N numbers.
template <int N>
struct PartBelief {
  Eigen::Matrix<double, N, 1> mean;
  const Eigen::Matrix<double, N, N>* covariance;
};

/// Moments of what the parts believe in model number `mode`; `share` of each, together 1.
template <int N, class Parts, class Share>
Gaussian<N> mixed_belief(const Parts& parts, std::size_t mode, const Share& share) {
  Gaussian<N> mixed;
  mixed.mean.setZero(), mixed.covariance.setZero();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (share(i) > 0) mixed.mean += share(i) * parts.template belief<N>(i, mode).mean;
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!(share(i) > 0)) continue;
    const PartBelief<N> part = parts.template belief<N>(i, mode);
    const Eigen::Matrix<double, N, 1> off = part.mean - mixed.mean;
    mixed.covariance += share(i) * (*part.covariance + off * off.transpose());
  }
  symmetrise(mixed.covariance);
  return mixed;
}

/// One bank in place of several of the same models, by moments: of each model the mixture of what
/// the parts believe, weighted by `weights`, which sum to 1, and the model's probability in each.
/// A model that is nowhere likely stays as `into` has it. Parts have size(), probability(i, mode)
/// and belief<N>(i, mode), and nothing of `into`.
template <int Axes, class Parts>
void mix_banks(const Parts& parts, std::span<const double> weights, ImmOf<Axes>& into) {
  ModeProbability probability = into.probability();
  for (std::size_t j = 0; j < into.modes().size(); ++j) {
    const auto weight = [&](std::size_t i) { return weights[i] * parts.probability(i, j); };
    double sum = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) sum += weight(i);
    probability[j] = sum;
    if (!(sum > 0)) continue;
    std::visit(
        [&]<class Model>(Mode<Model, Axes>& mode) {
          mode.belief = mixed_belief<Axes * Model::kParts>(
              parts, j, [&](std::size_t i) { return weight(i) / sum; });
        },
        into.modes()[j]);
  }
  into.set_probability(probability);
}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <span>
#include <type_traits>
#include <variant>

#include "glint/engine/filters/imm.hpp"

namespace glint {

/// What a model of a bank believes, `any` ModeOf<Axes>, which must have N numbers.
template <int N, class AnyMode>
auto& belief_of(AnyMode& any) {
  using Belief = std::conditional_t<std::is_const_v<AnyMode>, const Gaussian<N>, Gaussian<N>>;
  return *std::visit(
      [](auto& mode) -> Belief* {
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(mode.belief)>, Gaussian<N>>) {
          return &mode.belief;
        } else {
          return nullptr;
        }
      },
      any);
}

/// What a component of a mixture believes in a model of N numbers.
template <int N>
struct ComponentBelief {
  Eigen::Matrix<double, N, 1> mean;
  const Eigen::Matrix<double, N, N>* covariance;
};

/// How much each component counts in a model: `weights` times the model's probability in it, of a
/// sum over the components.
template <class Components>
struct ModelShares {
  const Components& components;
  std::span<const double> weights;
  std::size_t mode;
  double sum;
  double operator[](std::size_t i) const {
    return weights[i] * components.probability(i, mode) / sum;
  }
};

/// Mean and covariance of what the components believe in the model, which has N numbers.
template <int N, class Components>
Gaussian<N> mixed_belief(const ModelShares<Components>& share) {
  const Components& components = share.components;
  Gaussian<N> mixed;
  mixed.mean.setZero(), mixed.covariance.setZero();
  for (std::size_t i = 0; i < components.size(); ++i) {
    if (!(share[i] > 0)) continue;
    mixed.mean += share[i] * components.template belief<N>(i, share.mode).mean;
  }
  for (std::size_t i = 0; i < components.size(); ++i) {
    if (!(share[i] > 0)) continue;
    const ComponentBelief<N> part = components.template belief<N>(i, share.mode);
    const Eigen::Matrix<double, N, 1> off = part.mean - mixed.mean;
    mixed.covariance += share[i] * (*part.covariance + off * off.transpose());
  }
  symmetrise(mixed.covariance);
  return mixed;
}

/// One bank in place of several of the same models, by moments: of each model the mixture of what
/// the components believe, weighted by `weights`, which sum to 1, and by the model's probability in
/// each. A model that has no probability in any stays as `into` has it. Components have size(),
/// probability(i, mode) and belief<N>(i, mode), and nothing of `into`.
template <int Axes, class Components>
void mix_banks(const Components& components, std::span<const double> weights, ImmOf<Axes>& into) {
  ModeProbability probability = into.probability();
  for (std::size_t j = 0; j < into.modes().size(); ++j) {
    double sum = 0;
    for (std::size_t i = 0; i < components.size(); ++i) {
      sum += weights[i] * components.probability(i, j);
    }
    probability[j] = sum;
    if (!(sum > 0)) continue;
    const ModelShares<Components> share{components, weights, j, sum};
    std::visit(
        [&]<class Model>(Mode<Model, Axes>& mode) {
          mode.belief = mixed_belief<Axes * Model::kParts>(share);
        },
        into.modes()[j]);
  }
  into.set_probability(probability);
}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <span>
#include <variant>

#include "glint/engine/trackers/jpda/bank_mixture.hpp"
#include "glint/engine/trackers/jpda/hypothesis.hpp"
#include "glint/engine/trackers/jpda/hypothesis_updates.hpp"

namespace glint {

/// A hypothesis of a target together with what the target has in the newest scan.
struct Branch {
  std::size_t hypothesis;
  std::size_t option;  ///< 0 for none of its points, i + 1 for point i of its gate
};

/// The banks of branches, as the components of mix_banks().
template <class Sensor>
class HypothesisMixture {
 public:
  static constexpr int kAxes = Sensor::kAxes;

  /// `predicted`: all hypotheses at the scan, `updates` what its points make of them.
  HypothesisMixture(std::span<const Branch> branches, std::span<const Hypothesis<kAxes>> predicted,
                    const HypothesisUpdates<Sensor>& updates)
      : branches_(branches), predicted_(predicted), updates_(updates) {}

  std::size_t size() const { return branches_.size(); }
  double probability(std::size_t i, std::size_t mode) const {
    const auto [hypothesis, option] = branches_[i];
    return option > 0 ? updates_.probability(hypothesis, option - 1)[mode]
                      : predicted_[hypothesis].bank.probability()[mode];
  }
  /// (44), (47) with a point, (48) without.
  template <int N>
  ComponentBelief<N> belief(std::size_t i, std::size_t mode) const {
    const auto [hypothesis, option] = branches_[i];
    if (option > 0) return updates_.template belief<N>(hypothesis, option - 1, mode);
    const Gaussian<N>& missed = belief_of<N>(predicted_[hypothesis].bank.modes()[mode]);
    return {missed.mean, &missed.covariance};
  }
  /// What the first branch believes in every model, into `bank`, which has the same models.
  void take_first(ImmOf<kAxes>& bank) const {
    for (std::size_t j = 0; j < bank.modes().size(); ++j) {
      std::visit(
          [&]<class Model>(Mode<Model, kAxes>& mode) {
            const auto first = belief<kAxes * Model::kParts>(0, j);
            mode.belief.mean = first.mean, mode.belief.covariance = *first.covariance;
          },
          bank.modes()[j]);
    }
  }

 private:
  std::span<const Branch> branches_;
  std::span<const Hypothesis<kAxes>> predicted_;
  const HypothesisUpdates<Sensor>& updates_;
};

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "glint/engine/association/joint_events.hpp"

namespace glint {

/// A scan as a target sees it.
struct TargetScan {
  std::span<const std::uint32_t> points;  ///< in its gate, each once
  /// By hypothesis of the target, then: none of the points, ln(1 - P_D); each of them,
  /// ln(P_D p(z | hypothesis)) [1/volume].
  std::span<const double> log_weight;

  std::size_t options() const { return points.size() + 1; }
  double log_weight_of(std::size_t hypothesis, std::size_t option) const {
    return log_weight[hypothesis * options() + option];
  }
};

/// The joint events of a scan for a group of targets, one after another, each with its weight by
/// joint event of the scans before.
class ScanEvents {
 public:
  /// What a target may have in the scan: `allowed` options, 0 for none, else the point's number
  /// + 1.
  struct Choices {
    const TargetScan* scan = nullptr;
    std::vector<std::uint32_t> allowed;
  };
  /// K(d) = exp(d log_ratio) (m/m) (m/(m-1)) ... (m/(m-d+1)); without the product for m = 0.
  struct Factor {
    double log_ratio = 0, m = 0;
  };

  /// `choices`: by target of `before`, whose weights count as probabilities.
  void enumerate(const JointEvents& before, std::span<const Choices> choices, const Factor& factor);
  /// Of the events that serve the same targets with the same points leaves the likeliest.
  void keep_best_permutations(std::span<const Choices> choices);

  std::size_t size() const { return before_ > 0 ? weights_.size() / before_ : 0; }
  /// Of an event, by target.
  std::span<const std::uint32_t> options(std::size_t event) const {
    return std::span(options_).subspan(event * targets_, targets_);
  }
  /// Of an event, by event before.
  std::span<const double> weights(std::size_t event) const {
    return std::span(weights_).subspan(event * before_, before_);
  }
  double total() const;

 private:
  void scale(const JointEvents& before, std::span<const Choices> choices, const Factor& factor);
  void descend(std::size_t target, std::size_t assigned);

  std::size_t targets_ = 0, before_ = 0;
  std::vector<std::uint32_t> options_;
  std::vector<double> weights_;
  // Of the recursion: by target and allowed option and event before.
  std::span<const Choices> choices_;
  Factor factor_;
  std::vector<std::vector<double>> gains_;
  std::vector<double> partial_;  // by depth and event before
  std::vector<std::uint32_t> current_;
  std::vector<bool> used_;
};

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "glint/engine/trackers/jpda/joint_events.hpp"

namespace glint {

/// The points of a scan that a target may have.
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

/// The joint events of a scan for one group of targets after another, each with its weight by
/// joint event of the scans before. All lie in one piece of memory.
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
  /// Of one group.
  struct Group {
    std::size_t targets, before;  ///< how many, and how many events of the scans before
    std::span<const std::uint32_t> all_options;
    std::span<const double> all_weights;

    std::size_t size() const { return before > 0 ? all_weights.size() / before : 0; }
    /// Of an event, by target.
    std::span<const std::uint32_t> options(std::size_t event) const {
      return all_options.subspan(event * targets, targets);
    }
    /// Of an event, by event before.
    std::span<const double> weights(std::size_t event) const {
      return all_weights.subspan(event * before, before);
    }
    double total() const;
  };

  void clear() { ranges_.clear(), options_.clear(), weights_.clear(); }
  /// One group more. `choices`: by target of `before`, whose weights count as probabilities.
  void enumerate(const JointView& before, std::span<const Choices> choices, const Factor& factor);
  /// Of the newest group's events that serve the same targets with the same points leaves the
  /// likeliest.
  void keep_best_permutations(std::span<const Choices> choices);

  std::size_t groups() const { return ranges_.size(); }
  Group operator[](std::size_t group) const;

 private:
  struct Range {
    std::size_t targets, before, first_option, first_weight;
  };
  void scale(const JointView& before, std::span<const Choices> choices, const Factor& factor);
  void descend(std::size_t target, std::size_t assigned);
  void list_served(const Group& group, std::span<const Choices> choices);
  int compare(const Group& group, std::size_t a, std::size_t b) const;
  void keep(std::span<const std::size_t> events);

  std::vector<Range> ranges_;
  std::vector<std::uint32_t> options_;
  std::vector<double> weights_;
  // Of the recursion.
  std::size_t before_ = 0;
  std::span<const Choices> choices_;
  Factor factor_;
  std::vector<double> gains_;            // by target and allowed option and event before
  std::vector<std::size_t> first_gain_;  // by target
  std::vector<double> partial_;          // by depth and event before
  std::vector<std::uint32_t> current_;
  std::vector<bool> used_;
  // Of permutations, by event.
  std::vector<std::uint32_t> served_;  // its points, rising, and gaps
  std::vector<double> weight_;
  std::vector<std::size_t> order_, kept_;
};

}  // namespace glint

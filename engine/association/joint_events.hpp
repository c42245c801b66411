// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace glint {

/// What a group of targets may have done together: in each event every target has one of its own
/// hypotheses.
struct JointEvents {
  std::vector<std::uint32_t> targets;  ///< rising
  std::vector<std::uint32_t> choice;   ///< by event, then target: the number of its hypothesis
  std::vector<double> weight;          ///< by event

  std::size_t size() const { return weight.size(); }
  std::span<const std::uint32_t> event(std::size_t e) const {
    return std::span(choice).subspan(e * targets.size(), targets.size());
  }
  void add(std::span<const std::uint32_t> hypotheses, double event_weight);
};

/// A target that has one hypothesis.
JointEvents certain(std::uint32_t target);
/// All pairs of events of two groups that have nothing to do with each other.
JointEvents product(const JointEvents& a, const JointEvents& b);
/// What the events say of some of the targets: `columns`, rising, number them in the group.
JointEvents project(const JointEvents& events, std::span<const std::size_t> columns);
/// One event of those that are equal, with their weight together; by choice.
void merge_equal(JointEvents& events);
/// Leaves at most `most` events, the weightiest, none lighter than `least` times all; weights are
/// scaled to sum to 1.
void keep_best(JointEvents& events, std::size_t most, double least);

}  // namespace glint

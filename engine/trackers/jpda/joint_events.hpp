// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

namespace glint {

/// What a group of targets may have done together: in each event every target has one of its own
/// hypotheses.
struct JointView {
  std::span<const std::uint32_t> targets;  ///< rising
  std::span<const std::uint32_t> choice;   ///< by event, then target: the number of its hypothesis
  std::span<const double> weight;          ///< by event

  std::size_t size() const { return weight.size(); }
  std::span<const std::uint32_t> event(std::size_t e) const {
    return choice.subspan(e * targets.size(), targets.size());
  }
};

/// The same in memory of its own, to be used again and again.
struct JointEvents {
  std::vector<std::uint32_t> targets, choice;
  std::vector<double> weight;

  JointView view() const { return {targets, choice, weight}; }
  std::size_t size() const { return weight.size(); }
  std::span<const std::uint32_t> event(std::size_t e) const { return view().event(e); }
  /// No events, of these targets.
  void begin(std::span<const std::uint32_t> of_targets);
  void add(std::span<const std::uint32_t> hypotheses, double event_weight);
  void assign(const JointView& events);

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.targets, s.choice, s.weight);
  }
};

/// The joint events of one group of targets after another, in one piece of memory.
class JointGroups {
 public:
  void clear();
  void add(const JointView& group);
  /// A target that has one hypothesis.
  void add_certain(std::uint32_t target);
  std::size_t size() const { return ranges_.size(); }
  JointView operator[](std::size_t group) const;
  std::span<std::uint32_t> choice(std::size_t group);

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.ranges_, s.all_);
  }
  void restored() const;

 private:
  struct Range {
    std::size_t first_target, targets, first_choice, first_event, events;
    template <class Self>
    static auto fields(Self& s) {
      return std::tie(s.first_target, s.targets, s.first_choice, s.first_event, s.events);
    }
  };
  std::vector<Range> ranges_;
  JointEvents all_;
};

/// Memory of the functions below, to be used again.
struct JointWorkspace {
  std::vector<std::size_t> order;
  std::vector<std::uint32_t> hypotheses;
  JointEvents other;
};

/// Into `both`: all pairs of events of two groups that have nothing to do with each other.
void product(const JointView& a, const JointView& b, JointEvents& both, JointWorkspace& memory);
/// Into `some`: the events of some of the targets alone; `columns`, rising, number them in the
/// group.
void project(const JointView& events, std::span<const std::size_t> columns, JointEvents& some,
             JointWorkspace& memory);
/// One event of those that are equal, with their weight together; by choice.
void merge_equal(JointEvents& events, JointWorkspace& memory);
/// Leaves at most `most` events, the weightiest, none lighter than `least` times all; weights are
/// scaled to sum to 1.
void keep_best(JointEvents& events, std::size_t most, double least, JointWorkspace& memory);

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <vector>

#include "glint/engine/trackers/jpda/disjoint_sets.hpp"
#include "glint/engine/trackers/jpda/index_range.hpp"
#include "glint/engine/trackers/jpda/joint_events.hpp"
#include "glint/engine/trackers/jpda/jpda.hpp"
#include "glint/engine/trackers/jpda/scan_events.hpp"

namespace glint {

struct MultiscanSettings {
  /// Of the joint events that serve the same targets with the same points, only the likeliest
  /// counts (JPDA*: Blom and Bloem 2000). Otherwise two targets that once shared one point share
  /// both of theirs for ever.
  bool best_permutation = true;
  std::size_t work = std::size_t{1} << 16;  ///< most joint events of a cluster and scan
  std::size_t events = 256;                 ///< most that a group carries to the next scan
  double least = 1e-6;                      ///< probability below which an event is not carried

  /// No lists of joint events: each scan stands alone, summed by Jpda.
  static MultiscanSettings single_scan() {
    MultiscanSettings settings;
    settings.best_permutation = false, settings.work = 0;
    return settings;
  }
};

struct MultiscanReport {
  std::size_t clusters = 0;     ///< groups of targets with points, or coupled by scans before
  std::size_t independent = 0;  ///< of them too large to couple the scans
  std::size_t trimmed = 0;      ///< of them where the least likely points were left out
  std::size_t events = 0;       ///< most joint events of a cluster
  JpdaReport scan;              ///< of the newest scan alone
};

/// Joint probabilistic data association over a window of scans, P-JPDA section 4. A target carries
/// hypotheses: what its own points were in the scans of the window before this one. Given the joint
/// event of those scans it depends on its own hypothesis alone, so there is one filter a hypothesis
/// and not one a joint event; which hypotheses go together is kept as a list of joint events a
/// group of targets. A group is targets that share points in the scans of the window.
///
/// A cluster of more events than `work` does without its least likely points, and if that is not
/// enough, its targets are taken as independent given the scans before: single-scan JPDA.
class MultiscanJpda {
 public:
  explicit MultiscanJpda(const MultiscanSettings& settings) : settings_(settings) {}

  void clear();
  /// A target more, with one hypothesis, independent of all others.
  void add();
  void remove(std::size_t target);
  std::size_t targets() const { return own_.size(); }
  std::size_t hypotheses(std::size_t target) const { return own_[target].count; }

  /// A scan, one entry a target, which must live until advance(). The weights of a target may have
  /// any common factor.
  MultiscanReport run(std::span<const TargetScan> scan, const JpdaClutter& clutter);
  /// Probability of each hypothesis together with what the target has in the scan, by hypothesis,
  /// then: none, each of its points.
  std::span<const double> posterior(std::size_t target) const {
    return std::span(posterior_).subspan(first_[target], first_[target + 1] - first_[target]);
  }

  /// A hypothesis after advance().
  struct Child {
    std::uint32_t merged;  ///< number of the hypothesis before the scan, as merged
    std::uint32_t option;  ///< 0: none, or number of the point + 1
    double probability;
    template <class Self>
    static auto fields(Self& s) {
      return std::tie(s.merged, s.option, s.probability);
    }
  };
  /// The scan joins the window. `merged`: by target and hypothesis, the number that it has
  /// when hypotheses that differ in scans that leave the window are one; `memory`: scans for
  /// which targets stay together that shared a point, window - 1.
  void advance(std::span<const std::uint32_t> merged, int memory);
  std::span<const Child> children(std::size_t target) const { return own_[target].of(children_); }

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.own_, s.prior_, s.children_, s.groups_, s.bonds_);
  }
  void restored() const;

 private:
  static constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();
  struct Bond {
    std::uint32_t a, b;
    int scans;  ///< left
    template <class Self>
    static auto fields(Self& s) {
      return std::tie(s.a, s.b, s.scans);
    }
  };
  struct Cluster {
    JointView before;          ///< events of the scans before
    std::size_t events = 0;    ///< of the scan: number of the group in events_
    bool independent = false;  ///< too many to be listed
  };
  std::span<double> prior(std::size_t target) { return own_[target].of(prior_); }
  JpdaReport single_scan(const JpdaClutter& clutter);
  void find_clusters();
  void join_groups();
  bool trim(const Cluster& cluster, MultiscanReport& report);
  ScanEvents::Factor factor(const Cluster& cluster, const JpdaClutter& clutter) const;
  void solve(Cluster& cluster, const JpdaClutter& clutter, MultiscanReport& report);
  void add_posterior(const Cluster& cluster, double total);
  void solve_independent(const Cluster& cluster);
  void bond(int memory);
  void carry(const Cluster& cluster, std::span<const std::uint32_t> merged);
  void merge_before(const JointView& before, std::span<const std::uint32_t> merged);
  void carry_independent(std::uint32_t target, std::span<const std::uint32_t> merged);
  void split(JointEvents& events);
  void number_children(std::size_t group);

  MultiscanSettings settings_;
  std::vector<IndexRange> own_;  // by target: its hypotheses in prior_ and children_
  std::vector<double> prior_;    // by hypothesis
  std::vector<Child> children_;
  JointGroups groups_;
  std::vector<Bond> bonds_;

  // Of the scan at hand.
  std::span<const TargetScan> scan_;
  Jpda jpda_;
  std::vector<JpdaPair> pairs_;
  std::vector<double> log_missed_, log_mean_;  // log_mean_: over the hypotheses, by option
  std::vector<double> single_;                 // marginals of the scan alone, by option
  std::vector<std::size_t> first_option_, first_, first_hypothesis_;
  DisjointSets sets_;                  // of targets
  std::vector<std::uint32_t> holder_;  // by point
  std::vector<Cluster> clusters_;
  JointGroups before_;  // by cluster
  ScanEvents events_;
  std::vector<double> posterior_;

  // Memory to be used again.
  std::vector<std::uint32_t> cluster_of_root_, cluster_of_group_;
  std::vector<ScanEvents::Choices> choices_;  // by target of a cluster, and more
  JointGroups others_;
  JointEvents joint_, merged_before_, part_;
  JointWorkspace memory_;
  std::vector<std::size_t> into_, columns_;
  std::vector<std::uint32_t> hypotheses_, used_;
  std::vector<double> weights_;
};

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "glint/engine/state/bytes.hpp"
#include "glint/engine/trackers/jpda/hypothesis.hpp"
#include "glint/engine/trackers/jpda/hypothesis_mixture.hpp"
#include "glint/engine/trackers/jpda/hypothesis_updates.hpp"
#include "glint/engine/trackers/jpda/imm_window_config.hpp"
#include "glint/engine/trackers/jpda/index_range.hpp"
#include "glint/engine/trackers/jpda/multiscan_jpda.hpp"
#include "glint/engine/trackers/jpda/sensor_scan.hpp"
#include "glint/engine/trackers/jpda/validation_gate.hpp"

namespace glint {

/// Targets followed together through the scans of a window, each by a bank of motion models a
/// hypothesis: the IMM/Mscan-JPDA filter of P-JPDA section 4. A scan is process(), then advance()
/// if another one follows.
template <class Sensor>
class ImmMultiscanJpda {
 public:
  using Bank = ImmOf<Sensor::kAxes>;
  using Scan = SensorScan<Sensor>;

  explicit ImmMultiscanJpda(const ImmWindowConfig& config);

  /// A target more, with one hypothesis: as it was at the scan before the next.
  void add(const Bank& bank);
  void remove(std::size_t target);
  void clear();
  std::size_t targets() const { return targets_.size(); }

  /// Steps 2.1 to 2.6 of the paper.
  MultiscanReport process(const Scan& scan);
  /// The scan that was processed joins the window and the oldest leaves it: hypotheses that differ
  /// in that one alone are merged.
  void advance();

  /// A target after the last scan: the mixture of all its hypotheses.
  const Bank& estimate(std::size_t target) const { return targets_[target].estimate; }
  /// Of the last scan, by the number that the target had then: the probability that it has none
  /// of the scan's points; the numbers of the points in its gate, and the probability that it has
  /// each of them.
  double missed(std::size_t target) const { return associations_[target].missed; }
  std::span<const std::uint32_t> gated(std::size_t target) const {
    return associations_[target].gate.of(gated_);
  }
  std::span<const double> shares(std::size_t target) const {
    return associations_[target].gate.of(shares_);
  }

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.jpda_, s.targets_, s.hypotheses_);
  }
  void restored() const;
  /// Throws BytesError unless all banks are of the models of `bank`.
  void require_alike(const Bank& bank) const;

 private:
  struct Target {
    Bank estimate;
    IndexRange hypotheses{};
    template <class Self>
    static auto fields(Self& s) {
      return std::tie(s.estimate, s.hypotheses);
    }
  };
  /// A target and the points of the last scan.
  struct Association {
    IndexRange gate{};        // in gated_ and shares_
    IndexRange log_weight{};  // by hypothesis and option
    double missed = 1;
  };

  void predict(const Scan& scan);
  double validate(std::size_t target, const Scan& scan);
  void update(std::size_t target, const Scan& scan);
  void estimate_target(std::size_t target);
  void merge(std::size_t target, std::span<const std::uint32_t> merged);
  void merge_all();

  int memory_;  // scans of the window before the newest
  Linearisation linearisation_;
  JpdaClutter::Number clutter_;
  MultiscanJpda jpda_;
  std::vector<Target> targets_;
  std::vector<Hypothesis<Sensor::kAxes>> hypotheses_;  // of the first target, of the second, ...
  // Of the last scan.
  std::vector<Association> associations_;
  std::vector<std::uint32_t> gated_;
  std::vector<double> shares_, log_weight_;
  std::vector<BankPrediction<Sensor>> expected_;  // by hypothesis
  ValidationGate<Sensor> gate_;
  HypothesisUpdates<Sensor> updates_;
  // Memory to be used again.
  std::vector<TargetScan> scan_;
  std::vector<Hypothesis<Sensor::kAxes>> next_;
  std::vector<std::uint32_t> merged_;
  std::vector<Branch> branches_;
  std::vector<double> weights_;
};

template <class Sensor>
ImmMultiscanJpda<Sensor>::ImmMultiscanJpda(const ImmWindowConfig& config)
    : memory_(config.window - 1),
      linearisation_(config.linearisation),
      clutter_(config.clutter),
      jpda_(multiscan_settings(config)),
      gate_(config.gate),
      updates_(config.detection) {}

template <class Sensor>
void ImmMultiscanJpda<Sensor>::add(const Bank& bank) {
  targets_.push_back({bank, {hypotheses_.size(), 1}});
  hypotheses_.push_back({{}, bank});
  jpda_.add();
}

template <class Sensor>
void ImmMultiscanJpda<Sensor>::remove(std::size_t target) {
  const IndexRange gone = targets_[target].hypotheses;
  targets_.erase(targets_.begin() + static_cast<std::ptrdiff_t>(target));
  const auto first = hypotheses_.begin() + static_cast<std::ptrdiff_t>(gone.first);
  hypotheses_.erase(first, first + static_cast<std::ptrdiff_t>(gone.count));
  for (std::size_t t = target; t < targets(); ++t) targets_[t].hypotheses.first -= gone.count;
  jpda_.remove(target);
}

template <class Sensor>
void ImmMultiscanJpda<Sensor>::clear() {
  targets_.clear(), hypotheses_.clear(), jpda_.clear();
}

template <class Sensor>
MultiscanReport ImmMultiscanJpda<Sensor>::process(const Scan& scan) {
  JpdaClutter clutter{clutter_, scan.clutter_density, 0};
  associations_.assign(targets(), {});
  gated_.clear(), log_weight_.clear(), updates_.clear();
  predict(scan);
  for (std::size_t t = 0; t < targets(); ++t) {
    clutter.volume += validate(t, scan);
    update(t, scan);
  }
  scan_.clear();
  for (const Association& a : associations_) {
    scan_.push_back({a.gate.of(gated_), a.log_weight.of(log_weight_)});
  }
  const MultiscanReport report = jpda_.run(scan_, clutter);
  shares_.assign(gated_.size(), 0);
  for (std::size_t t = 0; t < targets(); ++t) estimate_target(t);
  return report;
}

/// P-JPDA (16)-(23), for each hypothesis.
template <class Sensor>
void ImmMultiscanJpda<Sensor>::predict(const Scan& scan) {
  expected_.clear();
  for (auto& hypothesis : hypotheses_) {
    hypothesis.bank.mix();
    hypothesis.bank.predict(scan.elapsed);
    expected_.push_back(predict_measurements(hypothesis.bank, scan.sensor, linearisation_));
  }
}

/// Finds the points of the target's gate; returns its volume.
template <class Sensor>
double ImmMultiscanJpda<Sensor>::validate(std::size_t target, const Scan& scan) {
  gate_.reset(scan.points.size());
  for (const auto& expected : targets_[target].hypotheses.of(expected_)) {
    gate_.add(expected, scan.points);
  }
  IndexRange& gate = associations_[target].gate;
  gate.first = gated_.size();
  for (std::uint32_t i = 0; i < scan.points.size(); ++i) {
    if (gate_.holds(i)) gated_.push_back(i);
  }
  gate.count = gated_.size() - gate.first;
  return gate_.volume();
}

template <class Sensor>
void ImmMultiscanJpda<Sensor>::update(std::size_t target, const Scan& scan) {
  Association& association = associations_[target];
  const IndexRange& own = targets_[target].hypotheses;
  association.log_weight.first = log_weight_.size();
  for (std::size_t h = own.first; h < own.first + own.count; ++h) {
    updates_.add(hypotheses_[h].bank, expected_[h], scan.points, association.gate.of(gated_),
                 log_weight_);
  }
  association.log_weight.count = log_weight_.size() - association.log_weight.first;
}

/// P-JPDA (43), (45), (52)-(54): moments over hypotheses and options, models apart.
template <class Sensor>
void ImmMultiscanJpda<Sensor>::estimate_target(std::size_t target) {
  Association& association = associations_[target];
  const auto posterior = jpda_.posterior(target);
  const std::size_t options = association.gate.count + 1;
  const std::span<double> shares = association.gate.of(shares_);
  association.missed = 0, branches_.clear();
  for (std::size_t i = 0; i < posterior.size(); ++i) {
    const std::size_t option = i % options;
    (option > 0 ? shares[option - 1] : association.missed) += posterior[i];
    branches_.push_back({targets_[target].hypotheses.first + i / options, option});
  }
  mix_banks(HypothesisMixture<Sensor>(branches_, hypotheses_, updates_), posterior,
            targets_[target].estimate);
}

template <class Sensor>
void ImmMultiscanJpda<Sensor>::advance() {
  if (memory_ == 0) return merge_all();
  merged_.clear();
  for (auto& hypothesis : hypotheses_) hypothesis.history.keep_newest(memory_ - 1);
  for (const Target& target : targets_) {
    number_histories<Sensor::kAxes>(target.hypotheses.of(hypotheses_), merged_);
  }
  jpda_.advance(merged_, memory_);
  next_.clear();
  for (std::size_t t = 0; t < targets(); ++t) merge(t, targets_[t].hypotheses.of(merged_));
  std::swap(hypotheses_, next_);
}

/// One hypothesis in place of those with the same history and the same option.
template <class Sensor>
void ImmMultiscanJpda<Sensor>::merge(std::size_t target, std::span<const std::uint32_t> merged) {
  IndexRange& own = targets_[target].hypotheses;
  const auto posterior = jpda_.posterior(target);
  const std::size_t first = next_.size(), options = associations_[target].gate.count + 1;
  for (const MultiscanJpda::Child& child : jpda_.children(target)) {
    branches_.clear(), weights_.clear();
    double sum = 0;
    for (std::size_t h = 0; h < merged.size(); ++h) {
      if (merged[h] != child.merged) continue;
      branches_.push_back({own.first + h, child.option});
      weights_.push_back(posterior[h * options + child.option]);
      sum += weights_.back();
    }
    for (double& w : weights_) w = sum > 0 ? w / sum : 1 / static_cast<double>(branches_.size());
    next_.push_back(hypotheses_[branches_.back().hypothesis]);
    auto& next = next_.back();
    const HypothesisMixture<Sensor> mixture(branches_, hypotheses_, updates_);
    mixture.take_first(next.bank);
    mix_banks(mixture, weights_, next.bank);
    next.history.append(child.option);
  }
  own = {first, next_.size() - first};
}

/// A window of one scan: each target goes on with its estimate.
template <class Sensor>
void ImmMultiscanJpda<Sensor>::merge_all() {
  jpda_.clear(), hypotheses_.clear();
  for (std::size_t t = 0; t < targets(); ++t) {
    targets_[t].hypotheses = {t, 1};
    hypotheses_.push_back({{}, targets_[t].estimate});
    jpda_.add();
  }
}

template <class Sensor>
void ImmMultiscanJpda<Sensor>::restored() const {
  std::size_t first = 0;
  require_bytes(jpda_.targets() == targets(), "targets and hypotheses do not fit");
  for (std::size_t t = 0; t < targets(); ++t) {
    const IndexRange& own = targets_[t].hypotheses;
    require_bytes(own.first == first && own.count == jpda_.hypotheses(t),
                  "targets and hypotheses do not fit");
    first += own.count;
  }
  require_bytes(first == hypotheses_.size(), "targets and hypotheses do not fit");
  for (const auto& hypothesis : hypotheses_) {
    require_bytes(hypothesis.history.scans() <= memory_, "a hypothesis is too long");
  }
}

template <class Sensor>
void ImmMultiscanJpda<Sensor>::require_alike(const Bank& bank) const {
  const bool all =
      std::ranges::all_of(targets_, [&](const Target& t) { return t.estimate.alike(bank); }) &&
      std::ranges::all_of(hypotheses_, [&](const auto& h) { return h.bank.alike(bank); });
  require_bytes(all, "a target moves by other models");
}

}  // namespace glint

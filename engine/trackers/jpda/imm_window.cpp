// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/jpda/imm_window.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "glint/engine/state/bytes.hpp"
#include "glint/engine/trackers/jpda/bank_mixture.hpp"
#include "glint/engine/trackers/jpda/measurement_prediction.hpp"

namespace glint {
namespace {

template <int Axes, int N>
void assign_belief(ModeOf<Axes>& any, const Gaussian<N>& belief) {
  std::visit(
      [&](auto& mode) {
        if constexpr (std::is_same_v<decltype(mode.belief), Gaussian<N>>) mode.belief = belief;
      },
      any);
}

}  // namespace

/// What mix_banks() mixes.
template <class Sensor>
struct ImmWindow<Sensor>::Parts {
  const ImmWindow& window;
  const Target& target;

  std::size_t size() const { return window.parts_.size(); }
  const Child& child(const Part& part) const {
    const std::size_t h = part.hypothesis - target.hypotheses.first;
    return window.children_[target.first_child + h * target.gate.count + part.option - 1];
  }
  double probability(std::size_t i, std::size_t mode) const {
    const Part& part = window.parts_[i];
    return part.option > 0 ? child(part).probability[mode]
                           : window.hypotheses_[part.hypothesis].bank.probability()[mode];
  }
  template <int N>
  PartBelief<N> belief(std::size_t i, std::size_t mode) const {
    constexpr int kAxes = Sensor::kAxes;
    const Part& part = window.parts_[i];
    if (part.option > 0) {
      return {child(part).mean[mode].template head<N>(),
              &belief_of<N, kAxes>(window.updated_[part.hypothesis][mode]).covariance};
    }
    const Bank& bank = window.hypotheses_[part.hypothesis].bank;
    const Gaussian<N>& missed = belief_of<N, kAxes>(bank.modes()[mode]);
    return {missed.mean, &missed.covariance};
  }
  /// What the first part believes in every model.
  void first(Bank& bank) const {
    for (std::size_t j = 0; j < bank.modes().size(); ++j) {
      std::visit(
          [&]<class Model>(Mode<Model, Sensor::kAxes>& mode) {
            const auto part = belief<Sensor::kAxes * Model::kParts>(0, j);
            mode.belief.mean = part.mean, mode.belief.covariance = *part.covariance;
          },
          bank.modes()[j]);
    }
  }
};

template <class Sensor>
void ImmWindow<Sensor>::add(const Bank& bank) {
  targets_.push_back({bank});
  if (settings_.reading == WindowReading::restart) {
    targets_.back().before.push_back(bank);
  } else {
    begin(static_cast<std::uint32_t>(targets() - 1), bank);
  }
}

/// The target enters the window with one hypothesis.
template <class Sensor>
void ImmWindow<Sensor>::begin(std::uint32_t target, const Bank& bank) {
  targets_[target].hypotheses = {hypotheses_.size(), 1};
  hypotheses_.push_back({{}, 0, bank});
  active_.push_back(target);
  jpda_.add();
}

template <class Sensor>
void ImmWindow<Sensor>::remove(std::size_t target) {
  const Range gone = targets_[target].hypotheses;
  targets_.erase(targets_.begin() + static_cast<std::ptrdiff_t>(target));
  if (settings_.reading == WindowReading::restart) return;
  jpda_.remove(target);
  active_.pop_back();
  const auto first = hypotheses_.begin() + static_cast<std::ptrdiff_t>(gone.first);
  hypotheses_.erase(first, first + static_cast<std::ptrdiff_t>(gone.count));
  for (std::size_t t = target; t < targets(); ++t) targets_[t].hypotheses.first -= gone.count;
}

template <class Sensor>
MultiscanReport ImmWindow<Sensor>::step(std::span<const Seen> points, const Sensor& sensor,
                                        double density, double elapsed) {
  newest_.points.assign(points.begin(), points.end());
  newest_.sensor = sensor, newest_.density = density, newest_.elapsed = elapsed;
  if (settings_.reading == WindowReading::restart) return restart(newest_);
  const MultiscanReport report = process_scan(newest_);
  if (settings_.scans == 1) {
    forget();
  } else {
    advance();
  }
  return report;
}

/// From each target's estimate before the window, or its start, through the scans since.
template <class Sensor>
MultiscanReport ImmWindow<Sensor>::restart(const PastScan& newest) {
  const std::size_t scans = past_.size() + 1;
  MultiscanReport report;
  for (std::size_t s = 0; s < scans; ++s) {
    for (std::uint32_t t = 0; t < targets(); ++t) {
      const std::vector<Bank>& before = targets_[t].before;
      if (before.size() == scans - s) begin(t, before.front());
    }
    report = process_scan(s + 1 < scans ? past_[s] : newest);
    if (s + 1 < scans) advance();
  }
  remember(newest);
  jpda_.clear(), active_.clear(), hypotheses_.clear();  // the next scan begins anew
  return report;
}

template <class Sensor>
void ImmWindow<Sensor>::remember(const PastScan& scan) {
  const auto most = static_cast<std::size_t>(settings_.scans);
  for (Target& target : targets_) {
    target.before.push_back(target.estimate);
    if (target.before.size() > most) target.before.erase(target.before.begin());
  }
  if (past_.size() + 1 < most) {
    past_.push_back(scan);
  } else if (most > 1) {
    std::rotate(past_.begin(), past_.begin() + 1, past_.end());
    past_.back() = scan;
  }
}

template <class Sensor>
MultiscanReport ImmWindow<Sensor>::process_scan(const PastScan& scan) {
  JpdaClutter clutter{settings_.clutter, scan.density, 0};
  gate_.clear(), shares_.clear(), log_weight_.clear(), children_.clear(), updated_.clear();
  for (const std::uint32_t t : active_) {
    Target& target = targets_[t];
    predict(target, scan);
    find_gate(target, scan);
    target.log_weight = {log_weight_.size(), target.hypotheses.count * target.options()};
    target.first_child = children_.size();
    for (std::size_t h = 0; h < target.hypotheses.count; ++h) {
      update(target, scan, target.hypotheses.first + h);
    }
    clutter.volume += target.volume;
  }
  scan_.clear();
  for (const std::uint32_t t : active_) {
    scan_.push_back({targets_[t].gate.of(gate_), targets_[t].log_weight.of(log_weight_)});
  }
  const MultiscanReport report = jpda_.run(scan_, clutter);
  for (std::size_t n = 0; n < active_.size(); ++n) estimate(targets_[active_[n]], n);
  return report;
}

/// P-JPDA (16)-(21), for each hypothesis.
template <class Sensor>
void ImmWindow<Sensor>::predict(const Target& target, const PastScan& scan) {
  for (std::size_t h = 0; h < target.hypotheses.count; ++h) {
    Bank& bank = hypotheses_[target.hypotheses.first + h].bank;
    bank.mix();
    bank.predict(scan.elapsed);
  }
}

/// The union of the gates; (24) centres the largest on one hypothesis. Its volume is that of the
/// largest, (26).
template <class Sensor>
void ImmWindow<Sensor>::find_gate(Target& target, const PastScan& scan) {
  gated_.assign(scan.points.size(), false), target.volume = 0;
  for (const Hypothesis& hypothesis : target.hypotheses.of(hypotheses_)) {
    for (const auto& any : hypothesis.bank.modes()) {
      std::visit([&](const auto& mode) { gate_of(mode.belief, target, scan); }, any);
    }
  }
  target.gate.first = gate_.size();
  for (std::uint32_t i = 0; i < scan.points.size(); ++i) {
    if (gated_[i]) gate_.push_back(i);
  }
  target.gate.count = gate_.size() - target.gate.first;
}

template <class Sensor>
template <int N>
void ImmWindow<Sensor>::gate_of(const Gaussian<N>& predicted, Target& target,
                                const PastScan& scan) {
  const auto expected = predict_measurement(predicted, scan.sensor, settings_.linearisation);
  target.volume = std::max(target.volume, expected.gate_volume(settings_.gate));
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    if (expected.distance(scan.points[i]) <= settings_.gate) gated_[i] = true;
  }
}

/// Where the hypothesis leads to with each point, and how likely it makes them: the sum over the
/// models of l^j(0) = 1 - P_D, l^j(i) = P_D N(y_i).
template <class Sensor>
void ImmWindow<Sensor>::update(const Target& target, const PastScan& scan, std::size_t hypothesis) {
  const Bank& bank = hypotheses_[hypothesis].bank;
  const std::size_t modes = bank.modes().size(), points = target.gate.count;
  Child child{bank.probability(), {}};
  for (std::size_t j = 0; j < modes; ++j) child.mean.push_back(Child::Mean::Zero());
  children_.resize(children_.size() + points, child);
  const std::span children = std::span(children_).last(points);
  updated_.push_back(bank.modes());
  log_likelihood_.assign(points * modes, 0);
  for (std::size_t j = 0; j < modes; ++j) {
    std::visit([&](const auto& mode) { update_mode(mode.belief, j, children, target, scan); },
               bank.modes()[j]);
  }
  log_weight_.push_back(std::log(1 - settings_.detection));
  for (std::size_t i = 0; i < points; ++i) {
    const std::span own = std::span(log_likelihood_).subspan(i * modes, modes);
    const double largest = *std::ranges::max_element(own);
    double sum = 0;
    for (std::size_t j = 0; j < modes; ++j) {
      sum += bank.probability()[j] * std::exp(own[j] - largest);
    }
    log_weight_.push_back(std::log(settings_.detection) + largest + std::log(sum));
    children[i].probability = weighed(bank.probability(), own);
  }
}

/// P-JPDA (42)-(48).
template <class Sensor>
template <int N>
void ImmWindow<Sensor>::update_mode(const Gaussian<N>& predicted, std::size_t mode,
                                    std::span<Child> children, const Target& target,
                                    const PastScan& scan) {
  const auto expected = predict_measurement(predicted, scan.sensor, settings_.linearisation);
  Gaussian<N> belief = predicted;
  belief.covariance -= expected.gain * expected.covariance * expected.gain.transpose();
  symmetrise(belief.covariance);
  assign_belief<Sensor::kAxes>(updated_.back()[mode], belief);
  const std::size_t modes = updated_.back().size();
  const std::span<const std::uint32_t> gate = target.gate.of(gate_);
  for (std::size_t i = 0; i < gate.size(); ++i) {
    const Seen& point = scan.points[gate[i]];
    belief.mean = predicted.mean + expected.gain * expected.innovation(point);
    children[i].mean[mode].template head<N>() = belief.mean;
    log_likelihood_[i * modes + mode] = expected.log_density(point);
  }
}

/// P-JPDA (43), (45), (52): moments over hypotheses and points, models apart.
template <class Sensor>
void ImmWindow<Sensor>::estimate(Target& target, std::size_t number) {
  const auto posterior = jpda_.posterior(number);
  const std::size_t options = target.options();
  const std::size_t first = shares_.size();
  target.missed = 0, shares_.resize(first + target.gate.count, 0);
  parts_.clear();
  for (std::size_t i = 0; i < posterior.size(); ++i) {
    const std::size_t option = i % options;
    (option > 0 ? shares_[first + option - 1] : target.missed) += posterior[i];
    parts_.push_back({target.hypotheses.first + i / options, option});
  }
  mix_banks(Parts{*this, target}, posterior, target.estimate);
}

/// The scan joins the window and the oldest leaves it: hypotheses that differ in that one alone
/// are merged.
template <class Sensor>
void ImmWindow<Sensor>::advance() {
  const int memory = settings_.scans - 1;
  merged_.clear();
  for (const std::uint32_t t : active_) name_merged(targets_[t], memory);
  jpda_.advance(merged_, memory);
  next_.clear();
  std::size_t first = 0;
  for (std::size_t n = 0; n < active_.size(); ++n) {
    Target& target = targets_[active_[n]];
    const std::size_t count = target.hypotheses.count;
    merge(target, n, std::span(merged_).subspan(first, count));
    first += count;
  }
  std::swap(hypotheses_, next_);
}

/// Forgets what leaves the window; hypotheses that then are alike get one number.
template <class Sensor>
void ImmWindow<Sensor>::name_merged(const Target& target, int memory) {
  const std::span hypotheses =
      std::span(hypotheses_).subspan(target.hypotheses.first, target.hypotheses.count);
  for (Hypothesis& h : hypotheses) {
    if (h.length == memory) {
      std::shift_left(h.history.begin(), h.history.end(), 1);
      --h.length;
    }
  }
  const auto history = [&](std::size_t h) {
    return std::span(hypotheses[h].history).first(static_cast<std::size_t>(hypotheses[h].length));
  };
  const std::size_t first = merged_.size();
  std::uint32_t count = 0;
  for (std::size_t h = 0; h < hypotheses.size(); ++h) {
    std::size_t same = 0;
    while (!std::ranges::equal(history(same), history(h))) ++same;
    merged_.push_back(same < h ? merged_[first + same] : count++);
  }
}

template <class Sensor>
void ImmWindow<Sensor>::merge(Target& target, std::size_t number,
                              std::span<const std::uint32_t> merged) {
  const auto posterior = jpda_.posterior(number);
  const std::size_t first = next_.size();
  for (const MultiscanJpda::Child& child : jpda_.children(number)) {
    parts_.clear(), weights_.clear();
    double sum = 0;
    for (std::size_t h = 0; h < merged.size(); ++h) {
      if (merged[h] != child.merged) continue;
      parts_.push_back({target.hypotheses.first + h, child.option});
      weights_.push_back(posterior[h * target.options() + child.option]);
      sum += weights_.back();
    }
    for (double& w : weights_) w = sum > 0 ? w / sum : 1 / static_cast<double>(parts_.size());
    next_.push_back(hypotheses_[parts_.back().hypothesis]);
    Hypothesis& next = next_.back();
    const Parts parts{*this, target};
    parts.first(next.bank);
    mix_banks(parts, weights_, next.bank);
    next.history[static_cast<std::size_t>(next.length++)] = child.option;
  }
  target.hypotheses = {first, next_.size() - first};
}

template <class Sensor>
void ImmWindow<Sensor>::restored() const {
  const auto most = static_cast<std::size_t>(settings_.scans);
  require_bytes(past_.size() < most, "a window has too many scans");
  if (settings_.reading == WindowReading::sliding) return check_hypotheses();
  require_bytes(active_.empty() && hypotheses_.empty() && jpda_.targets() == 0,
                "a window that restarts has hypotheses");
  for (const Target& target : targets_) {
    require_bytes(!target.before.empty() && target.before.size() <= most, "a target is not whole");
  }
}

template <class Sensor>
void ImmWindow<Sensor>::check_hypotheses() const {
  require_bytes(active_.size() == targets() && jpda_.targets() == targets(),
                "targets and hypotheses do not fit");
  std::size_t first = 0;
  for (std::uint32_t t = 0; t < targets(); ++t) {
    const Range& own = targets_[t].hypotheses;
    require_bytes(active_[t] == t && own.first == first && own.count == jpda_.hypotheses(t),
                  "targets and hypotheses do not fit");
    first += own.count;
  }
  require_bytes(first == hypotheses_.size(), "targets and hypotheses do not fit");
  for (const Hypothesis& h : hypotheses_) {
    require_bytes(h.length >= 0 && h.length < settings_.scans, "a hypothesis is too long");
  }
}

template <class Sensor>
void ImmWindow<Sensor>::require_alike(const Bank& bank) const {
  const auto alike = [&](const Bank& other) { return other.alike(bank); };
  const bool all = std::ranges::all_of(targets_, [&](const Target& target) {
    return alike(target.estimate) && std::ranges::all_of(target.before, alike);
  });
  require_bytes(all && std::ranges::all_of(hypotheses_, alike, &Hypothesis::bank),
                "a target moves by other models");
}

/// A window of one scan: all hypotheses are merged.
template <class Sensor>
void ImmWindow<Sensor>::forget() {
  jpda_.clear();
  for (const Target& target : targets_) {
    hypotheses_[target.hypotheses.first].bank = target.estimate;
    jpda_.add();
  }
}

template class ImmWindow<PositionSensor<2>>;
template class ImmWindow<RangeAzimuth>;
template class ImmWindow<RangeAzimuthElevation>;

}  // namespace glint

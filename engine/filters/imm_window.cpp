// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/filters/imm_window.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "glint/engine/filters/bank_mixture.hpp"
#include "glint/engine/filters/measurement_prediction.hpp"

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

template <class Sensor>
void ImmWindow<Sensor>::add(const Bank& bank) {
  Target target{bank, {}, {}, {bank}, {}, {}, {1}, {}};
  if (settings_.reading == WindowReading::sliding) {
    target.hypotheses.push_back({{}, 0, bank});
    active_.push_back(static_cast<std::uint32_t>(targets()));
    jpda_.add();
  }
  targets_.push_back(std::move(target));
}

template <class Sensor>
void ImmWindow<Sensor>::remove(std::size_t target) {
  targets_.erase(targets_.begin() + static_cast<std::ptrdiff_t>(target));
  if (settings_.reading == WindowReading::restart) return;
  jpda_.remove(target);
  active_.pop_back();
}

template <class Sensor>
MultiscanReport ImmWindow<Sensor>::step(std::span<const Seen> points, const Sensor& sensor,
                                        double density, double elapsed) {
  newest_.points.assign(points.begin(), points.end());
  newest_.sensor = sensor, newest_.density = density, newest_.elapsed = elapsed;
  if (settings_.reading == WindowReading::restart) return restart(newest_);
  const MultiscanReport report = take_in(newest_);
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
  jpda_.clear(), active_.clear();
  const std::size_t scans = past_.size() + 1;
  MultiscanReport report;
  for (std::size_t s = 0; s < scans; ++s) {
    for (std::uint32_t t = 0; t < targets(); ++t) {
      Target& target = targets_[t];
      if (target.before.size() != scans - s) continue;
      target.hypotheses.assign(1, {{}, 0, target.before.front()});
      active_.push_back(t), jpda_.add();
    }
    report = take_in(s + 1 < scans ? past_[s] : newest);
    if (s + 1 < scans) advance();
  }
  const auto most = static_cast<std::size_t>(settings_.scans);
  for (Target& target : targets_) {
    target.before.push_back(target.estimate);
    if (target.before.size() > most) target.before.erase(target.before.begin());
  }
  past_.push_back(newest);
  if (past_.size() >= most) past_.erase(past_.begin());
  return report;
}

template <class Sensor>
MultiscanReport ImmWindow<Sensor>::take_in(const PastScan& scan) {
  scan_.clear();
  JpdaClutter clutter{settings_.clutter, scan.density, 0};
  for (const std::uint32_t t : active_) {
    Target& target = targets_[t];
    predict(target, scan);
    find_gate(target, scan);
    for (std::size_t h = 0; h < target.hypotheses.size(); ++h) update(target, scan, h);
    clutter.volume += target.volume;
    scan_.push_back({target.gate, target.log_weight});
  }
  const MultiscanReport report = jpda_.run(scan_, clutter);
  for (std::size_t n = 0; n < active_.size(); ++n) estimate(targets_[active_[n]], n);
  return report;
}

/// P-JPDA (16)-(21), for each hypothesis.
template <class Sensor>
void ImmWindow<Sensor>::predict(Target& target, const PastScan& scan) {
  for (Hypothesis& hypothesis : target.hypotheses) {
    hypothesis.bank.mix();
    hypothesis.bank.predict(scan.elapsed);
  }
}

/// The union of the gates; (24) centres the largest on one hypothesis. Its volume is that of the
/// largest, (26).
template <class Sensor>
void ImmWindow<Sensor>::find_gate(Target& target, const PastScan& scan) {
  gated_.assign(scan.points.size(), false), target.volume = 0;
  for (const Hypothesis& hypothesis : target.hypotheses) {
    for (const auto& any : hypothesis.bank.modes()) {
      std::visit([&](const auto& mode) { gate_of(mode.belief, target, scan); }, any);
    }
  }
  target.gate.clear();
  for (std::uint32_t i = 0; i < scan.points.size(); ++i) {
    if (gated_[i]) target.gate.push_back(i);
  }
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
void ImmWindow<Sensor>::update(Target& target, const PastScan& scan, std::size_t hypothesis) {
  const Bank& bank = target.hypotheses[hypothesis].bank;
  const std::size_t options = target.gate.size() + 1, first = hypothesis * options;
  if (target.children.size() < first + options) target.children.resize(first + options, bank);
  target.log_weight.resize(first + options);
  const std::span children = std::span(target.children).subspan(first, options);
  std::ranges::fill(children, bank);
  const std::size_t modes = bank.modes().size();
  log_likelihood_.assign((options - 1) * modes, 0);
  for (std::size_t j = 0; j < modes; ++j) {
    std::visit([&](const auto& mode) { update_mode(mode.belief, j, children, target, scan); },
               bank.modes()[j]);
  }
  target.log_weight[first] = std::log(1 - settings_.detection);
  for (std::size_t i = 0; i + 1 < options; ++i) {
    const std::span own = std::span(log_likelihood_).subspan(i * modes, modes);
    const double largest = *std::ranges::max_element(own);
    double sum = 0;
    for (std::size_t j = 0; j < modes; ++j) {
      sum += bank.probability()[j] * std::exp(own[j] - largest);
    }
    target.log_weight[first + i + 1] = std::log(settings_.detection) + largest + std::log(sum);
    children[i + 1].weigh(own);
  }
}

/// P-JPDA (42)-(48).
template <class Sensor>
template <int N>
void ImmWindow<Sensor>::update_mode(const Gaussian<N>& predicted, std::size_t mode,
                                    std::span<Bank> children, const Target& target,
                                    const PastScan& scan) {
  const auto expected = predict_measurement(predicted, scan.sensor, settings_.linearisation);
  Gaussian<N> belief = predicted;
  belief.covariance -= expected.gain * expected.covariance * expected.gain.transpose();
  symmetrise(belief.covariance);
  for (std::size_t i = 0; i < target.gate.size(); ++i) {
    Bank& child = children[i + 1];
    const Seen& point = scan.points[target.gate[i]];
    belief.mean = predicted.mean + expected.gain * expected.innovation(point);
    assign_belief<Sensor::kAxes>(child.modes()[mode], belief);
    log_likelihood_[i * child.modes().size() + mode] = expected.log_density(point);
  }
}

/// P-JPDA (43), (45), (52): moments over hypotheses and points, models apart.
template <class Sensor>
void ImmWindow<Sensor>::estimate(Target& target, std::size_t number) {
  const auto posterior = jpda_.posterior(number);
  const std::size_t options = target.gate.size() + 1;
  target.share.assign(options, 0);
  for (std::size_t i = 0; i < posterior.size(); ++i) target.share[i % options] += posterior[i];
  mix_banks<Sensor::kAxes>(std::span<const Bank>(target.children).first(posterior.size()),
                           posterior, target.estimate);
}

/// The scan joins the window and the oldest leaves it: hypotheses that differ in that one alone
/// are merged.
template <class Sensor>
void ImmWindow<Sensor>::advance() {
  const int memory = settings_.scans - 1;
  merged_.clear();
  for (const std::uint32_t t : active_) {
    std::vector<Hypothesis>& hypotheses = targets_[t].hypotheses;
    std::uint32_t count = 0;
    const std::size_t first = merged_.size();
    for (Hypothesis& h : hypotheses) {
      if (h.length == memory) {
        std::shift_left(h.history.begin(), h.history.end(), 1);
        --h.length;
      }
    }
    for (std::size_t h = 0; h < hypotheses.size(); ++h) {
      std::size_t same = 0;
      const auto history = [&](std::size_t i) {
        return std::span(hypotheses[i].history)
            .first(static_cast<std::size_t>(hypotheses[i].length));
      };
      while (!std::ranges::equal(history(same), history(h))) ++same;
      merged_.push_back(same < h ? merged_[first + same] : count++);
    }
  }
  jpda_.advance(merged_, memory);
  std::size_t first = 0;
  for (std::size_t n = 0; n < active_.size(); ++n) {
    Target& target = targets_[active_[n]];
    const std::size_t count = target.hypotheses.size();
    merge(target, n, std::span(merged_).subspan(first, count));
    first += count;
  }
}

template <class Sensor>
void ImmWindow<Sensor>::merge(Target& target, std::size_t number,
                              std::span<const std::uint32_t> merged) {
  const auto posterior = jpda_.posterior(number);
  const std::size_t options = target.gate.size() + 1;
  target.next.clear();
  for (const MultiscanJpda::Child& child : jpda_.children(number)) {
    parts_.clear(), weights_.clear();
    double sum = 0;
    std::size_t of = 0;
    for (std::size_t h = 0; h < merged.size(); ++h) {
      if (merged[h] != child.merged) continue;
      const std::size_t at = h * options + child.option;
      parts_.push_back(target.children[at]), weights_.push_back(posterior[at]);
      sum += posterior[at], of = h;
    }
    for (double& w : weights_) w = sum > 0 ? w / sum : 1 / static_cast<double>(parts_.size());
    Hypothesis next = target.hypotheses[of];
    next.bank = parts_.front();
    mix_banks<Sensor::kAxes>(parts_, weights_, next.bank);
    next.history[static_cast<std::size_t>(next.length++)] = child.option;
    target.next.push_back(std::move(next));
  }
  std::swap(target.hypotheses, target.next);
}

/// A window of one scan: all hypotheses are merged.
template <class Sensor>
void ImmWindow<Sensor>::forget() {
  jpda_.clear();
  for (Target& target : targets_) {
    target.hypotheses.front().bank = target.estimate;
    jpda_.add();
  }
}

template class ImmWindow<PositionSensor<2>>;
template class ImmWindow<RangeAzimuth>;
template class ImmWindow<RangeAzimuthElevation>;

}  // namespace glint

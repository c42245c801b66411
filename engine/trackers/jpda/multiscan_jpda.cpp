// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/jpda/multiscan_jpda.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace glint {
namespace {

constexpr double kFirstTrim = 1e-6, kLastTrim = 0.01;

/// ln of the mean of exp(values) with the given weights.
template <class F>
double log_mean(std::span<const double> weights, const F& value) {
  double largest = -std::numeric_limits<double>::infinity(), sum = 0;
  for (std::size_t h = 0; h < weights.size(); ++h) largest = std::max(largest, value(h));
  if (!std::isfinite(largest)) return largest;
  for (std::size_t h = 0; h < weights.size(); ++h) sum += weights[h] * std::exp(value(h) - largest);
  return largest + std::log(sum);
}

}  // namespace

void MultiscanJpda::clear() {
  own_.clear(), prior_.clear(), children_.clear(), groups_.clear(), bonds_.clear();
}

void MultiscanJpda::add() {
  groups_.add_certain(static_cast<std::uint32_t>(targets()));
  own_.push_back({prior_.size(), 1});
  prior_.push_back(1), children_.push_back({0, 0, 1});
}

void MultiscanJpda::remove(std::size_t target) {
  own_.erase(own_.begin() + static_cast<std::ptrdiff_t>(target));
  others_.clear();
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const JointView group = groups_[g];
    columns_.clear();
    for (std::size_t c = 0; c < group.targets.size(); ++c) {
      if (group.targets[c] != target) columns_.push_back(c);
    }
    if (columns_.empty()) continue;
    if (columns_.size() < group.targets.size()) {
      project(group, columns_, part_, memory_);
    } else {
      part_.assign(group);
    }
    for (std::uint32_t& t : part_.targets) t -= t > target;
    others_.add(part_.view());
  }
  std::swap(groups_, others_);
  std::erase_if(bonds_, [&](const Bond& bond) { return bond.a == target || bond.b == target; });
  for (Bond& bond : bonds_) bond.a -= bond.a > target, bond.b -= bond.b > target;
}

MultiscanReport MultiscanJpda::run(std::span<const TargetScan> scan, const JpdaClutter& clutter) {
  scan_ = scan;
  first_option_.assign(1, 0), first_.assign(1, 0), first_hypothesis_.assign(1, 0);
  for (std::size_t t = 0; t < targets(); ++t) {
    first_option_.push_back(first_option_.back() + scan[t].options());
    first_.push_back(first_.back() + hypotheses(t) * scan[t].options());
    first_hypothesis_.push_back(first_hypothesis_.back() + hypotheses(t));
  }
  posterior_.assign(first_.back(), 0);
  MultiscanReport report;
  report.scan = single_scan(clutter);
  find_clusters();
  report.clusters = clusters_.size();
  events_.clear();
  for (Cluster& cluster : clusters_) solve(cluster, clutter, report);
  return report;
}

/// The scan as if the hypotheses of different targets had nothing to do with each other.
JpdaReport MultiscanJpda::single_scan(const JpdaClutter& clutter) {
  log_missed_.clear(), pairs_.clear(), log_mean_.clear();
  for (std::uint32_t t = 0; t < targets(); ++t) {
    for (std::size_t o = 0; o < scan_[t].options(); ++o) {
      log_mean_.push_back(
          log_mean(prior(t), [&](std::size_t h) { return scan_[t].log_weight_of(h, o); }));
      if (o > 0) pairs_.push_back({t, scan_[t].points[o - 1], log_mean_.back()});
    }
    log_missed_.push_back(log_mean_[first_option_[t]]);
  }
  const JpdaReport report = jpda_.run(log_missed_, pairs_, clutter);
  single_.clear();
  std::size_t pair = 0;
  for (std::size_t t = 0; t < targets(); ++t) {
    single_.push_back(jpda_.missed()[t]);
    for (std::size_t o = 1; o < scan_[t].options(); ++o) {
      single_.push_back(jpda_.associated()[pair++]);
    }
  }
  return report;
}

void MultiscanJpda::find_clusters() {
  sets_.reset(targets());
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    for (const std::uint32_t t : groups_[g].targets) sets_.join(t, groups_[g].targets.front());
  }
  std::uint32_t points = 0;
  for (const JpdaPair& pair : pairs_) points = std::max(points, pair.point + 1);
  holder_.assign(points, kNobody);
  for (const JpdaPair& pair : pairs_) {
    std::uint32_t& holder = holder_[pair.point];
    if (holder != kNobody) sets_.join(holder, pair.target);
    holder = pair.target;
  }
  join_groups();
}

/// Those of a cluster become one, whose events are all pairs of theirs.
void MultiscanJpda::join_groups() {
  std::uint32_t count = 0;
  cluster_of_root_.assign(targets(), kNobody), cluster_of_group_.clear();
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    std::uint32_t& n = cluster_of_root_[sets_.root(groups_[g].targets.front())];
    if (n == kNobody) n = count++;
    cluster_of_group_.push_back(n);
  }
  before_.clear();
  for (std::uint32_t n = 0; n < count; ++n) {
    const auto next = [&](auto from) {
      return std::ranges::find(from, cluster_of_group_.end(), n);
    };
    auto group = next(cluster_of_group_.begin());
    const auto view = [&] { return groups_[std::size_t(group - cluster_of_group_.begin())]; };
    joint_.assign(view());
    for (group = next(group + 1); group != cluster_of_group_.end(); group = next(group + 1)) {
      product(joint_.view(), view(), part_, memory_);
      keep_best(part_, settings_.events, 0, memory_);
      std::swap(joint_, part_);
    }
    before_.add(joint_.view());
  }
  clusters_.clear();
  for (std::size_t n = 0; n < count; ++n) clusters_.push_back({before_[n]});
}

/// Leaves out the least likely points of each target until the events are few enough. False if
/// that does not help.
bool MultiscanJpda::trim(const Cluster& cluster, MultiscanReport& report) {
  if (settings_.work == 0) return false;
  const JointView& before = cluster.before;
  if (choices_.size() < before.targets.size()) choices_.resize(before.targets.size());
  for (double least = 0; least <= kLastTrim; least = least == 0 ? kFirstTrim : 10 * least) {
    auto count = static_cast<double>(before.size());
    for (std::size_t c = 0; c < before.targets.size(); ++c) {
      const std::uint32_t t = before.targets[c];
      choices_[c].scan = &scan_[t];
      auto& allowed = choices_[c].allowed;
      allowed.clear();
      for (std::uint32_t o = 0; o < scan_[t].options(); ++o) {
        if (single_[first_option_[t] + o] >= least) allowed.push_back(o);
      }
      count *= static_cast<double>(allowed.size());
    }
    if (count <= static_cast<double>(settings_.work)) {
      report.trimmed += least > 0;
      return count > 0;
    }
  }
  return false;
}

/// Clutter of any number: the targets of other clusters have as many points as they are expected to
/// have, if each scan stood alone.
ScanEvents::Factor MultiscanJpda::factor(const Cluster& cluster, const JpdaClutter& clutter) const {
  if (clutter.number == JpdaClutter::Number::poisson) return {-std::log(clutter.density), 0};
  double points = 0, elsewhere = 0;
  for (const std::uint32_t holder : holder_) points += holder != kNobody;
  for (std::size_t t = 0; t < targets(); ++t) {
    if (!std::ranges::binary_search(cluster.before.targets, t)) {
      elsewhere += 1 - single_[first_option_[t]];
    }
  }
  const double m = std::max(points - elsewhere, 1.0);
  return {std::log(clutter.volume / m), m};
}

void MultiscanJpda::solve(Cluster& cluster, const JpdaClutter& clutter, MultiscanReport& report) {
  double total = 0;
  if (trim(cluster, report)) {
    const auto choices = std::span(std::as_const(choices_)).first(cluster.before.targets.size());
    cluster.events = events_.groups();
    events_.enumerate(cluster.before, choices, factor(cluster, clutter));
    if (settings_.best_permutation) events_.keep_best_permutations(choices);
    const ScanEvents::Group events = events_[cluster.events];
    report.events = std::max(report.events, events.size() * events.before);
    total = events.total();
  }
  cluster.independent = !(total > 0);
  if (cluster.independent) {
    ++report.independent;
    return solve_independent(cluster);
  }
  add_posterior(cluster, total);
}

void MultiscanJpda::add_posterior(const Cluster& cluster, double total) {
  const JointView& before = cluster.before;
  const ScanEvents::Group events = events_[cluster.events];
  for (std::size_t i = 0; i < events.size(); ++i) {
    const auto options = events.options(i);
    const auto weights = events.weights(i);
    for (std::size_t e = 0; e < before.size(); ++e) {
      const auto event = before.event(e);
      for (std::size_t c = 0; c < options.size(); ++c) {
        const std::uint32_t t = before.targets[c];
        posterior_[first_[t] + event[c] * scan_[t].options() + options[c]] += weights[e] / total;
      }
    }
  }
}

void MultiscanJpda::solve_independent(const Cluster& cluster) {
  for (const std::uint32_t t : cluster.before.targets) {
    const std::size_t options = scan_[t].options();
    for (std::size_t h = 0; h < hypotheses(t); ++h) {
      for (std::size_t o = 0; o < options; ++o) {
        const double mean = log_mean_[first_option_[t] + o];
        const double share = std::isfinite(mean)
                                 ? std::exp(scan_[t].log_weight_of(h, o) - mean)
                                 : 1.0;  // nothing fits: the hypotheses stay as likely as they were
        posterior_[first_[t] + h * options + o] =
            prior(t)[h] * share * single_[first_option_[t] + o];
      }
    }
  }
}

}  // namespace glint

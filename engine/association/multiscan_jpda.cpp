// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/association/multiscan_jpda.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace glint {
namespace {

constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();
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

void MultiscanJpda::clear() { prior_.clear(), groups_.clear(), bonds_.clear(); }

void MultiscanJpda::add() {
  groups_.push_back(certain(static_cast<std::uint32_t>(targets())));
  prior_.push_back({1});
}

void MultiscanJpda::remove(std::size_t target) {
  prior_.erase(prior_.begin() + static_cast<std::ptrdiff_t>(target));
  for (JointEvents& group : groups_) {
    std::vector<std::size_t> others;
    for (std::size_t c = 0; c < group.targets.size(); ++c) {
      if (group.targets[c] != target) others.push_back(c);
    }
    if (others.size() < group.targets.size()) group = project(group, others);
    for (std::uint32_t& t : group.targets) t -= t > target;
  }
  std::erase_if(groups_, [](const JointEvents& group) { return group.targets.empty(); });
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
  for (Cluster& cluster : clusters_) solve(cluster, clutter, report);
  return report;
}

/// The scan as if the hypotheses of different targets had nothing to do with each other.
JpdaReport MultiscanJpda::single_scan(const JpdaClutter& clutter) {
  log_missed_.clear(), pairs_.clear(), log_mean_.clear();
  for (std::uint32_t t = 0; t < targets(); ++t) {
    for (std::size_t o = 0; o < scan_[t].options(); ++o) {
      log_mean_.push_back(
          log_mean(prior_[t], [&](std::size_t h) { return scan_[t].log_weight_of(h, o); }));
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

std::uint32_t MultiscanJpda::root(std::uint32_t target) {
  while (parent_[target] != target) target = parent_[target] = parent_[parent_[target]];
  return target;
}

void MultiscanJpda::join(std::uint32_t a, std::uint32_t b) {
  a = root(a), b = root(b);
  parent_[std::max(a, b)] = std::min(a, b);
}

void MultiscanJpda::find_clusters() {
  parent_.resize(targets());
  std::iota(parent_.begin(), parent_.end(), 0u);
  for (const JointEvents& group : groups_) {
    for (const std::uint32_t t : group.targets) join(t, group.targets.front());
  }
  std::uint32_t points = 0;
  for (const JpdaPair& pair : pairs_) points = std::max(points, pair.point + 1);
  holder_.assign(points, kNobody);
  for (const JpdaPair& pair : pairs_) {
    std::uint32_t& holder = holder_[pair.point];
    if (holder != kNobody) join(holder, pair.target);
    holder = pair.target;
  }
  std::vector<std::uint32_t> number(targets(), kNobody);
  clusters_.clear();
  for (const JointEvents& group : groups_) {
    std::uint32_t& n = number[root(group.targets.front())];
    if (n == kNobody) {
      n = static_cast<std::uint32_t>(clusters_.size());
      clusters_.emplace_back().before = group;
    } else {
      JointEvents& before = clusters_[n].before;
      before = product(before, group);
      keep_best(before, settings_.events, 0);
    }
  }
}

/// Leaves out the least likely points of each target until the events are few enough. False if
/// that does not help.
bool MultiscanJpda::trim(Cluster& cluster, MultiscanReport& report) const {
  const JointEvents& before = cluster.before;
  cluster.choices.resize(before.targets.size());
  for (double least = 0; least <= kLastTrim; least = least == 0 ? kFirstTrim : 10 * least) {
    auto count = static_cast<double>(before.size());
    for (std::size_t c = 0; c < before.targets.size(); ++c) {
      const std::uint32_t t = before.targets[c];
      cluster.choices[c].scan = &scan_[t];
      auto& allowed = cluster.choices[c].allowed;
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
  const JointEvents& before = cluster.before;
  ScanEvents& events = cluster.events;
  double total = 0;
  if (trim(cluster, report)) {
    events.enumerate(before, cluster.choices, factor(cluster, clutter));
    if (settings_.best_permutation) events.keep_best_permutations(cluster.choices);
    report.events = std::max(report.events, events.size() * before.size());
    total = events.total();
  }
  cluster.independent = !(total > 0);
  if (cluster.independent) {
    ++report.independent;
    return solve_apart(cluster);
  }
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

void MultiscanJpda::solve_apart(Cluster& cluster) {
  for (const std::uint32_t t : cluster.before.targets) {
    const std::size_t options = scan_[t].options();
    for (std::size_t h = 0; h < hypotheses(t); ++h) {
      for (std::size_t o = 0; o < options; ++o) {
        const double mean = log_mean_[first_option_[t] + o];
        const double share = std::isfinite(mean)
                                 ? std::exp(scan_[t].log_weight_of(h, o) - mean)
                                 : 1.0;  // nothing fits: the hypotheses stay as likely as they were
        posterior_[first_[t] + h * options + o] =
            prior_[t][h] * share * single_[first_option_[t] + o];
      }
    }
  }
}

void MultiscanJpda::advance(std::span<const std::uint32_t> merged, int memory) {
  bond(memory);
  groups_.clear();
  children_.resize(targets());
  for (const Cluster& cluster : clusters_) {
    if (!cluster.independent) {
      carry(cluster, merged);
    } else {
      for (const std::uint32_t t : cluster.before.targets) carry_apart(t, merged);
    }
  }
  for (JointEvents& group : groups_) number_children(group);
}

/// Targets that share a point stay together for a while.
void MultiscanJpda::bond(int memory) {
  for (Bond& bond : bonds_) --bond.scans;
  std::erase_if(bonds_, [](const Bond& bond) { return bond.scans <= 0; });
  if (memory <= 0) return;
  std::ranges::fill(holder_, kNobody);
  for (const JpdaPair& pair : pairs_) {
    std::uint32_t& holder = holder_[pair.point];
    if (holder != kNobody) bonds_.push_back({holder, pair.target, memory});
    holder = pair.target;
  }
}

/// The events before and of the scan become one list; those before that differ in nothing that is
/// still told apart are one.
void MultiscanJpda::carry(const Cluster& cluster, std::span<const std::uint32_t> merged) {
  const JointEvents& before = cluster.before;
  const std::size_t targets = before.targets.size();
  JointEvents merged_before, joint;
  merged_before.targets = joint.targets = before.targets;
  std::vector<std::uint32_t> hypotheses(targets);
  const auto merge = [&](std::size_t e) {
    for (std::size_t c = 0; c < targets; ++c) {
      hypotheses[c] = merged[first_hypothesis_[before.targets[c]] + before.event(e)[c]];
    }
  };
  for (std::size_t e = 0; e < before.size(); ++e) merge(e), merged_before.add(hypotheses, 1);
  merge_equal(merged_before);
  std::vector<std::size_t> into(before.size());
  for (std::size_t e = 0; e < before.size(); ++e) {
    merge(e);
    while (!std::ranges::equal(merged_before.event(into[e]), hypotheses)) ++into[e];
  }
  std::vector<double> weights(merged_before.size());
  for (std::size_t i = 0; i < cluster.events.size(); ++i) {
    std::ranges::fill(weights, 0);
    for (std::size_t e = 0; e < before.size(); ++e) {
      weights[into[e]] += cluster.events.weights(i)[e];
    }
    for (std::size_t e = 0; e < weights.size(); ++e) {
      for (std::size_t c = 0; c < targets; ++c) {
        const auto options = static_cast<std::uint32_t>(scan_[before.targets[c]].options());
        hypotheses[c] = merged_before.event(e)[c] * options + cluster.events.options(i)[c];
      }
      if (weights[e] > 0) joint.add(hypotheses, weights[e]);
    }
  }
  split(std::move(joint));
}

void MultiscanJpda::carry_apart(std::uint32_t target, std::span<const std::uint32_t> merged) {
  JointEvents own;
  own.targets = {target};
  const auto options = static_cast<std::uint32_t>(scan_[target].options());
  for (std::size_t h = 0; h < hypotheses(target); ++h) {
    for (std::uint32_t o = 0; o < options; ++o) {
      const std::uint32_t child = merged[first_hypothesis_[target] + h] * options + o;
      own.add(std::span(&child, 1), posterior(target)[h * options + o]);
    }
  }
  merge_equal(own);
  keep_best(own, settings_.events, settings_.least);
  groups_.push_back(std::move(own));
}

/// Targets that shared no point of the window go their own ways.
void MultiscanJpda::split(JointEvents&& events) {
  for (const std::uint32_t t : events.targets) parent_[t] = t;
  for (const Bond& bond : bonds_) {
    if (std::ranges::binary_search(events.targets, bond.a) &&
        std::ranges::binary_search(events.targets, bond.b)) {
      join(bond.a, bond.b);
    }
  }
  std::vector<std::size_t> columns;
  for (const std::uint32_t first : events.targets) {
    if (root(first) != first) continue;
    columns.clear();
    for (std::size_t c = 0; c < events.targets.size(); ++c) {
      if (root(events.targets[c]) == first) columns.push_back(c);
    }
    groups_.push_back(columns.size() < events.targets.size() ? project(events, columns) : events);
    keep_best(groups_.back(), settings_.events, settings_.least);
  }
}

void MultiscanJpda::number_children(JointEvents& group) {
  const std::size_t targets = group.targets.size();
  for (std::size_t c = 0; c < targets; ++c) {
    const std::uint32_t t = group.targets[c];
    const auto options = static_cast<std::uint32_t>(scan_[t].options());
    std::vector<std::uint32_t> used;
    for (std::size_t e = 0; e < group.size(); ++e) used.push_back(group.event(e)[c]);
    std::ranges::sort(used);
    used.erase(std::unique(used.begin(), used.end()), used.end());
    children_[t].clear(), prior_[t].assign(used.size(), 0);
    for (std::size_t e = 0; e < group.size(); ++e) {
      std::uint32_t& choice = group.choice[e * targets + c];
      choice = static_cast<std::uint32_t>(std::ranges::lower_bound(used, choice) - used.begin());
      prior_[t][choice] += group.weight[e];
    }
    for (std::size_t h = 0; h < used.size(); ++h) {
      children_[t].push_back({used[h] / options, used[h] % options, prior_[t][h]});
    }
  }
}

}  // namespace glint

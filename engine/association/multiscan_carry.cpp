// SPDX-License-Identifier: Apache-2.0
// How the joint events of a scan become those that the next one begins with.
#include <algorithm>
#include <utility>

#include "glint/engine/association/multiscan_jpda.hpp"

namespace glint {

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

// SPDX-License-Identifier: Apache-2.0
// How the joint events of a scan become those that the next one begins with.
#include <algorithm>
#include <cmath>

#include "glint/engine/state/bytes.hpp"
#include "glint/engine/trackers/jpda/multiscan_jpda.hpp"

namespace glint {

void MultiscanJpda::advance(std::span<const std::uint32_t> merged, int memory) {
  bond(memory);
  groups_.clear();
  for (const Cluster& cluster : clusters_) {
    if (!cluster.independent) {
      carry(cluster, merged);
    } else {
      for (const std::uint32_t t : cluster.before.targets) carry_independent(t, merged);
    }
  }
  prior_.clear(), children_.clear();
  for (std::size_t g = 0; g < groups_.size(); ++g) number_children(g);
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

/// The events before and of the scan become one list. Events before that differ only in scans that
/// leave the window are one.
void MultiscanJpda::carry(const Cluster& cluster, std::span<const std::uint32_t> merged) {
  const JointView& before = cluster.before;
  const ScanEvents::Group events = events_[cluster.events];
  const std::size_t targets = before.targets.size();
  merge_before(before, merged);
  joint_.begin(before.targets);
  for (std::size_t i = 0; i < events.size(); ++i) {
    weights_.assign(merged_before_.size(), 0);
    for (std::size_t e = 0; e < before.size(); ++e) weights_[into_[e]] += events.weights(i)[e];
    for (std::size_t e = 0; e < weights_.size(); ++e) {
      for (std::size_t c = 0; c < targets; ++c) {
        const auto options = static_cast<std::uint32_t>(scan_[before.targets[c]].options());
        hypotheses_[c] = merged_before_.event(e)[c] * options + events.options(i)[c];
      }
      if (weights_[e] > 0) joint_.add(hypotheses_, weights_[e]);
    }
  }
  split(joint_);
}

/// Into merged_before_, with its number for each of `before` in into_.
void MultiscanJpda::merge_before(const JointView& before, std::span<const std::uint32_t> merged) {
  hypotheses_.resize(before.targets.size());
  const auto merge = [&](std::size_t e) {
    for (std::size_t c = 0; c < hypotheses_.size(); ++c) {
      hypotheses_[c] = merged[first_hypothesis_[before.targets[c]] + before.event(e)[c]];
    }
  };
  merged_before_.begin(before.targets);
  for (std::size_t e = 0; e < before.size(); ++e) merge(e), merged_before_.add(hypotheses_, 1);
  merge_equal(merged_before_, memory_);
  into_.assign(before.size(), 0);
  for (std::size_t e = 0; e < before.size(); ++e) {
    merge(e);
    while (!std::ranges::equal(merged_before_.event(into_[e]), hypotheses_)) ++into_[e];
  }
}

void MultiscanJpda::carry_independent(std::uint32_t target, std::span<const std::uint32_t> merged) {
  part_.begin(std::span(&target, 1));
  const auto options = static_cast<std::uint32_t>(scan_[target].options());
  for (std::size_t h = 0; h < hypotheses(target); ++h) {
    for (std::uint32_t o = 0; o < options; ++o) {
      const std::uint32_t child = merged[first_hypothesis_[target] + h] * options + o;
      part_.add(std::span(&child, 1), posterior(target)[h * options + o]);
    }
  }
  merge_equal(part_, memory_);
  keep_best(part_, settings_.events, settings_.least, memory_);
  groups_.add(part_.view());
}

/// Targets that shared no point of the window go their own ways.
void MultiscanJpda::split(JointEvents& events) {
  for (const std::uint32_t t : events.targets) sets_.isolate(t);
  for (const Bond& bond : bonds_) {
    if (std::ranges::binary_search(events.targets, bond.a) &&
        std::ranges::binary_search(events.targets, bond.b)) {
      sets_.join(bond.a, bond.b);
    }
  }
  for (const std::uint32_t first : events.targets) {
    if (sets_.root(first) != first) continue;
    columns_.clear();
    for (std::size_t c = 0; c < events.targets.size(); ++c) {
      if (sets_.root(events.targets[c]) == first) columns_.push_back(c);
    }
    const bool all = columns_.size() == events.targets.size();
    if (!all) project(events.view(), columns_, part_, memory_);
    JointEvents& own = all ? events : part_;
    keep_best(own, settings_.events, settings_.least, memory_);
    groups_.add(own.view());
  }
}

/// Every target is in one group, which names hypotheses that it has, and no more events than are
/// carried: groups that meet are multiplied.
void MultiscanJpda::restored() const {
  require_bytes(children_.size() == prior_.size(), "hypotheses are not whole");
  for (const IndexRange& own : own_) {
    require_bytes(own.count > 0 && own.count <= settings_.events && own.first <= prior_.size() &&
                      own.count <= prior_.size() - own.first,
                  "a target has no such hypotheses");
  }
  std::size_t grouped = 0;
  std::vector<bool> seen(targets());
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const JointView group = groups_[g];
    require_bytes(group.size() > 0 && group.size() <= settings_.events,
                  "a group has no such number of events");
    for (std::size_t c = 0; c < group.targets.size(); ++c, ++grouped) {
      const std::uint32_t t = group.targets[c];
      require_bytes(t < targets() && !seen[t] && (c == 0 || group.targets[c - 1] < t),
                    "a group has no such target");
      seen[t] = true;
      for (std::size_t e = 0; e < group.size(); ++e) {
        require_bytes(group.event(e)[c] < hypotheses(t), "a target has no such hypothesis");
      }
    }
  }
  require_bytes(grouped == targets(), "a target is in no group");
  require_bytes(std::ranges::all_of(prior_, [](double p) { return p >= 0 && std::isfinite(p); }),
                "a hypothesis has no such probability");
  for (const Bond& bond : bonds_) {
    require_bytes(bond.a < targets() && bond.b < targets(), "a bond has no such target");
  }
}

void MultiscanJpda::number_children(std::size_t group) {
  const JointView events = groups_[group];
  const std::span<std::uint32_t> choices = groups_.choice(group);
  const std::size_t targets = events.targets.size();
  for (std::size_t c = 0; c < targets; ++c) {
    const std::uint32_t t = events.targets[c];
    const auto options = static_cast<std::uint32_t>(scan_[t].options());
    used_.clear();
    for (std::size_t e = 0; e < events.size(); ++e) used_.push_back(events.event(e)[c]);
    std::ranges::sort(used_);
    used_.erase(std::unique(used_.begin(), used_.end()), used_.end());
    own_[t] = {prior_.size(), used_.size()};
    prior_.resize(prior_.size() + used_.size(), 0);
    for (std::size_t e = 0; e < events.size(); ++e) {
      std::uint32_t& choice = choices[e * targets + c];
      choice = static_cast<std::uint32_t>(std::ranges::lower_bound(used_, choice) - used_.begin());
      prior(t)[choice] += events.weight[e];
    }
    for (std::size_t h = 0; h < used_.size(); ++h) {
      children_.push_back({used_[h] / options, used_[h] % options, prior(t)[h]});
    }
  }
}

}  // namespace glint

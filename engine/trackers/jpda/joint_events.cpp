// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/jpda/joint_events.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include "glint/engine/state/bytes.hpp"

namespace glint {
namespace {

void number(std::vector<std::size_t>& order, std::size_t count) {
  order.resize(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
}

double sum(std::span<const double> weights) {
  return std::accumulate(weights.begin(), weights.end(), 0.0);
}

}  // namespace

void JointEvents::begin(std::span<const std::uint32_t> of_targets) {
  targets.assign(of_targets.begin(), of_targets.end());
  choice.clear(), weight.clear();
}

void JointEvents::add(std::span<const std::uint32_t> hypotheses, double event_weight) {
  choice.insert(choice.end(), hypotheses.begin(), hypotheses.end());
  weight.push_back(event_weight);
}

void JointEvents::assign(const JointView& events) {
  begin(events.targets);
  choice.assign(events.choice.begin(), events.choice.end());
  weight.assign(events.weight.begin(), events.weight.end());
}

void JointGroups::clear() {
  ranges_.clear();
  all_.begin({});
}

/// Groups follow each other without gaps.
void JointGroups::restored() const {
  std::size_t target = 0, choice = 0, event = 0;
  for (const Range& r : ranges_) {
    require_bytes(r.first_target == target && r.first_choice == choice && r.first_event == event &&
                      r.targets > 0 && r.targets <= all_.targets.size() &&
                      r.events <= all_.weight.size(),
                  "a group of joint events is not whole");
    target += r.targets, choice += r.targets * r.events, event += r.events;
  }
  require_bytes(
      target == all_.targets.size() && choice == all_.choice.size() && event == all_.weight.size(),
      "joint events are not whole");
  require_bytes(
      std::ranges::all_of(all_.weight, [](double w) { return w >= 0 && std::isfinite(w); }),
      "a joint event has no such weight");
}

void JointGroups::add(const JointView& group) {
  ranges_.push_back({all_.targets.size(), group.targets.size(), all_.choice.size(),
                     all_.weight.size(), group.size()});
  all_.targets.insert(all_.targets.end(), group.targets.begin(), group.targets.end());
  all_.choice.insert(all_.choice.end(), group.choice.begin(), group.choice.end());
  all_.weight.insert(all_.weight.end(), group.weight.begin(), group.weight.end());
}

void JointGroups::add_certain(std::uint32_t target) {
  constexpr std::uint32_t kFirst = 0;
  constexpr double kAll = 1;
  add({std::span(&target, 1), std::span(&kFirst, 1), std::span(&kAll, 1)});
}

JointView JointGroups::operator[](std::size_t group) const {
  const Range& r = ranges_[group];
  return {std::span(all_.targets).subspan(r.first_target, r.targets),
          std::span(all_.choice).subspan(r.first_choice, r.events * r.targets),
          std::span(all_.weight).subspan(r.first_event, r.events)};
}

std::span<std::uint32_t> JointGroups::choice(std::size_t group) {
  const Range& r = ranges_[group];
  return std::span(all_.choice).subspan(r.first_choice, r.events * r.targets);
}

void product(const JointView& a, const JointView& b, JointEvents& both, JointWorkspace& memory) {
  both.begin({});
  std::ranges::merge(a.targets, b.targets, std::back_inserter(both.targets));
  std::vector<std::uint32_t>& hypotheses = memory.hypotheses;
  hypotheses.resize(both.targets.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < b.size(); ++k) {
      std::size_t from_a = 0, from_b = 0;
      for (std::size_t t = 0; t < hypotheses.size(); ++t) {
        const bool of_a = from_a < a.targets.size() && a.targets[from_a] == both.targets[t];
        hypotheses[t] = of_a ? a.event(i)[from_a++] : b.event(k)[from_b++];
      }
      both.add(hypotheses, a.weight[i] * b.weight[k]);
    }
  }
}

void project(const JointView& events, std::span<const std::size_t> columns, JointEvents& some,
             JointWorkspace& memory) {
  some.begin({});
  for (const std::size_t c : columns) some.targets.push_back(events.targets[c]);
  std::vector<std::uint32_t>& hypotheses = memory.hypotheses;
  hypotheses.resize(columns.size());
  for (std::size_t e = 0; e < events.size(); ++e) {
    for (std::size_t c = 0; c < columns.size(); ++c) hypotheses[c] = events.event(e)[columns[c]];
    some.add(hypotheses, events.weight[e]);
  }
  merge_equal(some, memory);
}

void merge_equal(JointEvents& events, JointWorkspace& memory) {
  std::vector<std::size_t>& order = memory.order;
  number(order, events.size());
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
    const auto x = events.event(a), y = events.event(b);
    const auto [i, k] = std::ranges::mismatch(x, y);
    return i != x.end() ? *i < *k : a < b;
  });
  JointEvents& merged = memory.other;
  merged.begin(events.targets);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto event = events.event(order[i]);
    if (i > 0 && std::ranges::equal(event, events.event(order[i - 1]))) {
      merged.weight.back() += events.weight[order[i]];
    } else {
      merged.add(event, events.weight[order[i]]);
    }
  }
  std::swap(events, merged);
}

void keep_best(JointEvents& events, std::size_t most, double least, JointWorkspace& memory) {
  std::vector<std::size_t>& order = memory.order;
  number(order, events.size());
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
    const double x = events.weight[a], y = events.weight[b];
    return x != y ? x > y : a < b;
  });
  const double all = sum(events.weight);
  std::size_t count = std::min(most, events.size());
  while (count > 1 && events.weight[order[count - 1]] < least * all) --count;
  order.resize(count);
  std::ranges::sort(order);
  const std::size_t targets = events.targets.size();
  for (std::size_t i = 0; i < count; ++i) {  // to the front: order[i] >= i
    if (order[i] == i) continue;
    std::ranges::copy(events.event(order[i]),
                      events.choice.begin() + static_cast<std::ptrdiff_t>(i * targets));
    events.weight[i] = events.weight[order[i]];
  }
  events.choice.resize(count * targets), events.weight.resize(count);
  const double left = sum(events.weight);
  for (double& w : events.weight) w = left > 0 ? w / left : 1 / static_cast<double>(count);
}

}  // namespace glint

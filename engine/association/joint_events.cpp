// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/association/joint_events.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace glint {
namespace {

std::vector<std::size_t> numbers(std::size_t count) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  return order;
}

JointEvents of_targets(const JointEvents& events) {
  JointEvents empty;
  empty.targets = events.targets;
  return empty;
}

}  // namespace

void JointEvents::add(std::span<const std::uint32_t> hypotheses, double event_weight) {
  choice.insert(choice.end(), hypotheses.begin(), hypotheses.end());
  weight.push_back(event_weight);
}

JointEvents certain(std::uint32_t target) { return {{target}, {0}, {1}}; }

JointEvents product(const JointEvents& a, const JointEvents& b) {
  JointEvents both;
  std::ranges::merge(a.targets, b.targets, std::back_inserter(both.targets));
  std::vector<std::uint32_t> hypotheses(both.targets.size());
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
  return both;
}

JointEvents project(const JointEvents& events, std::span<const std::size_t> columns) {
  JointEvents some;
  for (const std::size_t c : columns) some.targets.push_back(events.targets[c]);
  std::vector<std::uint32_t> hypotheses(columns.size());
  for (std::size_t e = 0; e < events.size(); ++e) {
    for (std::size_t c = 0; c < columns.size(); ++c) hypotheses[c] = events.event(e)[columns[c]];
    some.add(hypotheses, events.weight[e]);
  }
  merge_equal(some);
  return some;
}

void merge_equal(JointEvents& events) {
  std::vector<std::size_t> order = numbers(events.size());
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
    const auto x = events.event(a), y = events.event(b);
    const auto [i, k] = std::ranges::mismatch(x, y);
    return i != x.end() ? *i < *k : a < b;
  });
  JointEvents merged = of_targets(events);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto event = events.event(order[i]);
    if (i > 0 && std::ranges::equal(event, events.event(order[i - 1]))) {
      merged.weight.back() += events.weight[order[i]];
    } else {
      merged.add(event, events.weight[order[i]]);
    }
  }
  events = std::move(merged);
}

void keep_best(JointEvents& events, std::size_t most, double least) {
  const auto sum = [](const JointEvents& of) {
    return std::accumulate(of.weight.begin(), of.weight.end(), 0.0);
  };
  std::vector<std::size_t> order = numbers(events.size());
  std::ranges::stable_sort(order, std::greater{}, [&](std::size_t e) { return events.weight[e]; });
  const double all = sum(events);
  std::size_t count = std::min(most, events.size());
  while (count > 1 && events.weight[order[count - 1]] < least * all) --count;
  order.resize(count);
  std::ranges::sort(order);
  JointEvents best = of_targets(events);
  for (const std::size_t e : order) best.add(events.event(e), events.weight[e]);
  const double left = sum(best);
  for (double& w : best.weight) w = left > 0 ? w / left : 1 / static_cast<double>(count);
  events = std::move(best);
}

}  // namespace glint

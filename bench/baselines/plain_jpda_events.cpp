// SPDX-License-Identifier: Apache-2.0
#include "glint/bench/baselines/plain_jpda_events.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

namespace glint::bench {

std::vector<std::vector<int>> components(int count, const std::vector<std::pair<int, int>>& pairs) {
  std::vector<int> label(static_cast<std::size_t>(count));
  std::iota(label.begin(), label.end(), 0);
  for (const auto& [a, b] : pairs) {
    const int from = label[static_cast<std::size_t>(a)], to = label[static_cast<std::size_t>(b)];
    std::ranges::replace(label, std::max(from, to), std::min(from, to));
  }
  std::map<int, std::vector<int>> by_label;
  for (int i = 0; i < count; ++i) by_label[label[static_cast<std::size_t>(i)]].push_back(i);
  std::vector<std::vector<int>> all;
  for (auto& [first, members] : by_label) all.push_back(std::move(members));
  return all;
}

void keep_best(PlainEvents& events, std::size_t most, double least) {
  std::vector<double> weights;
  weights.reserve(events.size());
  for (const auto& [event, weight] : events) weights.push_back(weight);
  std::ranges::sort(weights, std::greater{});
  const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
  const double lightest = std::max(weights[std::min(most, weights.size()) - 1], least * all);
  std::erase_if(events, [&](const auto& event) { return event.second < lightest; });
  double left = 0;
  for (const auto& [event, weight] : events) left += weight;
  for (auto& [event, weight] : events) weight /= left;
}

}  // namespace glint::bench

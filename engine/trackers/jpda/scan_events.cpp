// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/jpda/scan_events.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace glint {

double ScanEvents::Group::total() const {
  return std::accumulate(all_weights.begin(), all_weights.end(), 0.0);
}

ScanEvents::Group ScanEvents::operator[](std::size_t group) const {
  const Range& r = ranges_[group];
  const bool newest = group + 1 == ranges_.size();
  const std::size_t end_option = newest ? options_.size() : ranges_[group + 1].first_option;
  const std::size_t end_weight = newest ? weights_.size() : ranges_[group + 1].first_weight;
  return {r.targets, r.before,
          std::span(options_).subspan(r.first_option, end_option - r.first_option),
          std::span(weights_).subspan(r.first_weight, end_weight - r.first_weight)};
}

void ScanEvents::enumerate(const JointView& before, std::span<const Choices> choices,
                           const Factor& factor) {
  ranges_.push_back({choices.size(), before.size(), options_.size(), weights_.size()});
  before_ = before.size(), choices_ = choices, factor_ = factor;
  std::uint32_t points = 0;
  for (const Choices& c : choices) {
    for (const std::uint32_t point : c.scan->points) points = std::max(points, point + 1);
  }
  used_.assign(points, false);
  current_.assign(choices.size(), 0);
  scale(before, choices, factor);
  partial_.resize((choices.size() + 1) * before_);
  std::ranges::copy(before.weight, partial_.begin());
  descend(0, 0);
}

/// A target's largest weight becomes 1.
void ScanEvents::scale(const JointView& before, std::span<const Choices> choices,
                       const Factor& factor) {
  gains_.clear(), first_gain_.clear();
  for (std::size_t t = 0; t < choices.size(); ++t) {
    const Choices& c = choices[t];
    const std::size_t first = gains_.size();
    first_gain_.push_back(first);
    for (const std::uint32_t option : c.allowed) {
      for (std::size_t e = 0; e < before_; ++e) {
        gains_.push_back(c.scan->log_weight_of(before.event(e)[t], option) +
                         (option > 0 ? factor.log_ratio : 0));
      }
    }
    const std::span<double> gain = std::span(gains_).subspan(first);
    double largest = -std::numeric_limits<double>::infinity();
    for (const double g : gain) largest = std::max(largest, g);
    for (double& g : gain) g = std::isfinite(largest) ? std::exp(g - largest) : 0;
  }
}

void ScanEvents::descend(std::size_t target, std::size_t assigned) {
  const std::span<const double> from = std::span(partial_).subspan(target * before_, before_);
  if (target == choices_.size()) {
    double factor = 1;  // of K(d)
    for (std::size_t k = 0; factor_.m > 0 && k < assigned; ++k) {
      factor *= factor_.m / (factor_.m - static_cast<double>(k));
    }
    options_.insert(options_.end(), current_.begin(), current_.end());
    for (const double weight : from) weights_.push_back(weight * factor);
    return;
  }
  const Choices& choices = choices_[target];
  const std::span<const double> gains = std::span(gains_).subspan(first_gain_[target]);
  const std::span<double> to = std::span(partial_).subspan((target + 1) * before_, before_);
  for (std::size_t o = 0; o < choices.allowed.size(); ++o) {
    const std::uint32_t option = choices.allowed[o];
    const std::uint32_t point = option > 0 ? choices.scan->points[option - 1] : 0;
    if (option > 0 && used_[point]) continue;
    double largest = 0;
    for (std::size_t e = 0; e < before_; ++e) {
      to[e] = from[e] * gains[o * before_ + e];
      largest = std::max(largest, to[e]);
    }
    if (largest == 0) continue;
    current_[target] = option;
    if (option > 0) used_[point] = true;
    descend(target + 1, assigned + (option > 0));
    if (option > 0) used_[point] = false;
  }
}

void ScanEvents::keep_best_permutations(std::span<const Choices> choices) {
  const Group group = (*this)[groups() - 1];
  list_served(group, choices);
  order_.resize(group.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::ranges::sort(order_, [&](std::size_t a, std::size_t b) {
    const int c = compare(group, a, b);
    if (c != 0) return c < 0;
    return weight_[a] != weight_[b] ? weight_[a] > weight_[b] : a < b;
  });
  kept_.clear();
  for (std::size_t i = 0; i < order_.size(); ++i) {
    if (i == 0 || compare(group, order_[i - 1], order_[i]) != 0) kept_.push_back(order_[i]);
  }
  std::ranges::sort(kept_);
  keep(kept_);
}

void ScanEvents::list_served(const Group& group, std::span<const Choices> choices) {
  served_.resize(group.size() * group.targets), weight_.resize(group.size());
  for (std::size_t i = 0; i < group.size(); ++i) {
    const std::span own = std::span(served_).subspan(i * group.targets, group.targets);
    for (std::size_t t = 0; t < group.targets; ++t) {
      const std::uint32_t option = group.options(i)[t];
      own[t] = option > 0 ? choices[t].scan->points[option - 1] + 1 : 0;
    }
    std::ranges::sort(own);
    const auto by_event_before = group.weights(i);
    weight_[i] = std::accumulate(by_event_before.begin(), by_event_before.end(), 0.0);
  }
}

/// By the targets served, then the points that serve them.
int ScanEvents::compare(const Group& group, std::size_t a, std::size_t b) const {
  for (std::size_t t = 0; t < group.targets; ++t) {
    const bool x = group.options(a)[t] > 0, y = group.options(b)[t] > 0;
    if (x != y) return x < y ? -1 : 1;
  }
  for (std::size_t t = 0; t < group.targets; ++t) {
    const std::uint32_t x = served_[a * group.targets + t], y = served_[b * group.targets + t];
    if (x != y) return x < y ? -1 : 1;
  }
  return 0;
}

/// Of the newest group leaves these events, by rising number.
void ScanEvents::keep(std::span<const std::size_t> events) {
  const Range& r = ranges_.back();
  const auto move = [](auto& values, std::size_t first, std::size_t from, std::size_t to,
                       std::size_t count) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(first);
    std::copy_n(begin + static_cast<std::ptrdiff_t>(from * count), count,
                begin + static_cast<std::ptrdiff_t>(to * count));
  };
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (events[i] == i) continue;
    move(options_, r.first_option, events[i], i, r.targets);
    move(weights_, r.first_weight, events[i], i, r.before);
  }
  options_.resize(r.first_option + events.size() * r.targets);
  weights_.resize(r.first_weight + events.size() * r.before);
}

}  // namespace glint

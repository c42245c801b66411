// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/association/scan_events.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace glint {

void ScanEvents::enumerate(const JointEvents& before, std::span<const Choices> choices,
                           const Factor& factor) {
  targets_ = choices.size(), before_ = before.size();
  choices_ = choices, factor_ = factor;
  options_.clear(), weights_.clear();
  std::uint32_t points = 0;
  for (const Choices& c : choices) {
    for (const std::uint32_t point : c.scan->points) points = std::max(points, point + 1);
  }
  used_.assign(points, false);
  current_.assign(targets_, 0);
  scale(before, choices, factor);
  partial_.resize((targets_ + 1) * before_);
  std::ranges::copy(before.weight, partial_.begin());
  descend(0, 0);
}

/// A target's largest weight becomes 1.
void ScanEvents::scale(const JointEvents& before, std::span<const Choices> choices,
                       const Factor& factor) {
  gains_.resize(targets_);
  for (std::size_t t = 0; t < targets_; ++t) {
    const Choices& c = choices[t];
    std::vector<double>& gain = gains_[t];
    gain.clear();
    for (const std::uint32_t option : c.allowed) {
      for (std::size_t e = 0; e < before_; ++e) {
        gain.push_back(c.scan->log_weight_of(before.event(e)[t], option) +
                       (option > 0 ? factor.log_ratio : 0));
      }
    }
    double largest = -std::numeric_limits<double>::infinity();
    for (const double g : gain) largest = std::max(largest, g);
    for (double& g : gain) g = std::isfinite(largest) ? std::exp(g - largest) : 0;
  }
}

void ScanEvents::descend(std::size_t target, std::size_t assigned) {
  const std::span<const double> from = std::span(partial_).subspan(target * before_, before_);
  if (target == targets_) {
    double factor = 1;  // of K(d)
    for (std::size_t k = 0; factor_.m > 0 && k < assigned; ++k) {
      factor *= factor_.m / (factor_.m - static_cast<double>(k));
    }
    options_.insert(options_.end(), current_.begin(), current_.end());
    for (const double weight : from) weights_.push_back(weight * factor);
    return;
  }
  const Choices& choices = choices_[target];
  const std::span<double> to = std::span(partial_).subspan((target + 1) * before_, before_);
  for (std::size_t o = 0; o < choices.allowed.size(); ++o) {
    const std::uint32_t option = choices.allowed[o];
    const std::uint32_t point = option > 0 ? choices.scan->points[option - 1] : 0;
    if (option > 0 && used_[point]) continue;
    double largest = 0;
    for (std::size_t e = 0; e < before_; ++e) {
      to[e] = from[e] * gains_[target][o * before_ + e];
      largest = std::max(largest, to[e]);
    }
    if (largest == 0) continue;
    current_[target] = option;
    if (option > 0) used_[point] = true;
    descend(target + 1, assigned + (option > 0));
    if (option > 0) used_[point] = false;
  }
}

double ScanEvents::total() const { return std::accumulate(weights_.begin(), weights_.end(), 0.0); }

void ScanEvents::keep_best_permutations(std::span<const Choices> choices) {
  const std::size_t count = size();
  std::vector<std::uint32_t> served(count * targets_);  // by event: its points, rising, and gaps
  std::vector<double> weight(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::span own = std::span(served).subspan(i * targets_, targets_);
    for (std::size_t t = 0; t < targets_; ++t) {
      const std::uint32_t option = options(i)[t];
      own[t] = option > 0 ? choices[t].scan->points[option - 1] + 1 : 0;
    }
    std::ranges::sort(own);
    const auto by_event_before = weights(i);
    weight[i] = std::accumulate(by_event_before.begin(), by_event_before.end(), 0.0);
  }
  const auto compare = [&](std::size_t a, std::size_t b) {
    for (std::size_t t = 0; t < targets_; ++t) {
      const bool x = options(a)[t] > 0, y = options(b)[t] > 0;
      if (x != y) return x < y ? -1 : 1;
    }
    for (std::size_t t = 0; t < targets_; ++t) {
      const std::uint32_t x = served[a * targets_ + t], y = served[b * targets_ + t];
      if (x != y) return x < y ? -1 : 1;
    }
    return 0;
  };
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
    const int c = compare(a, b);
    if (c != 0) return c < 0;
    return weight[a] != weight[b] ? weight[a] > weight[b] : a < b;
  });
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < count; ++i) {
    if (i == 0 || compare(order[i - 1], order[i]) != 0) kept.push_back(order[i]);
  }
  std::ranges::sort(kept);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    std::ranges::copy(options(kept[i]),
                      options_.begin() + static_cast<std::ptrdiff_t>(i * targets_));
    std::ranges::copy(weights(kept[i]),
                      weights_.begin() + static_cast<std::ptrdiff_t>(i * before_));
  }
  options_.resize(kept.size() * targets_), weights_.resize(kept.size() * before_);
}

}  // namespace glint

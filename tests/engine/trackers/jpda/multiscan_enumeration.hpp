// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include "glint/engine/trackers/jpda/multiscan_jpda.hpp"

// Two scans by the sum over all their joint events.
namespace glint::test {

using Number = JpdaClutter::Number;
using Event = std::vector<std::uint32_t>;  // of a scan, by target: 0, or point + 1

/// A scan in which every target may have every point. Weights by target, its option in the scan
/// before (one of `parents`), and option.
struct FullScan {
  FullScan(std::mt19937& random, std::size_t targets, std::uint32_t points, std::size_t parents) {
    std::uniform_real_distribution<double> uniform(-4, 2);
    for (std::uint32_t p = 0; p < points; ++p) all.push_back(p);
    log_weight.resize(targets);
    for (auto& own : log_weight) {
      for (std::size_t i = 0; i < parents * (points + 1); ++i) own.push_back(uniform(random));
    }
  }
  std::vector<TargetScan> seen() const {
    std::vector<TargetScan> scan;
    for (const auto& own : log_weight) scan.push_back({all, own});
    return scan;
  }
  double weight(std::size_t target, std::uint32_t parent, std::uint32_t option) const {
    return std::exp(log_weight[target][parent * (all.size() + 1) + option]);
  }

  std::vector<std::uint32_t> all;
  std::vector<std::vector<double>> log_weight;
};

inline std::vector<Event> all_events(std::size_t targets, std::size_t points) {
  std::vector<Event> events{{}};
  for (std::size_t t = 0; t < targets; ++t) {
    std::vector<Event> longer;
    for (const Event& event : events) {
      for (std::uint32_t o = 0; o <= points; ++o) {
        if (o > 0 && std::ranges::find(event, o) != event.end()) continue;
        longer.push_back(event), longer.back().push_back(o);
      }
    }
    events = longer;
  }
  return events;
}

inline double clutter_weight(const JpdaClutter& clutter, std::size_t points, const Event& event) {
  const auto m = static_cast<double>(points);
  const auto d = static_cast<double>(std::ranges::count_if(event, [](auto o) { return o > 0; }));
  if (clutter.number == Number::poisson) return std::pow(clutter.density, m - d);
  return std::tgamma(m - d + 1) / std::tgamma(m + 1) * std::pow(clutter.volume, d - m);
}

inline double event_weight(const FullScan& scan, const JpdaClutter& clutter, const Event& before,
                           const Event& event) {
  double weight = clutter_weight(clutter, scan.all.size(), event);
  for (std::size_t t = 0; t < event.size(); ++t) weight *= scan.weight(t, before[t], event[t]);
  return weight;
}

using EventWeights = std::map<Event, double>;

/// Weights of the events of a scan by those of the scan before; `best` keeps one permutation.
struct TwoScans {
  TwoScans(const EventWeights& before, const FullScan& scan, const JpdaClutter& clutter,
           bool best = false) {
    const std::size_t targets = scan.log_weight.size();
    std::map<std::pair<std::vector<bool>, Event>, std::pair<double, Event>> likeliest;
    for (const Event& event : all_events(targets, scan.all.size())) {
      double sum = 0;
      for (const auto& [old, weight] : before) {
        sum += weight * event_weight(scan, clutter, old, event);
      }
      Event points = event;
      std::ranges::sort(points);
      std::vector<bool> served;
      for (const auto o : event) served.push_back(o > 0);
      auto& held = likeliest[{served, points}];
      if (sum > held.first) held = {sum, event};
      if (!best) after[event] = sum;
    }
    if (best) {
      for (const auto& [key, held] : likeliest) after[held.second] = held.first;
    }
    for (const auto& [event, unused] : after) {
      for (const auto& [old, weight] : before) {
        const double both = weight * event_weight(scan, clutter, old, event);
        all += both;
        for (std::size_t t = 0; t < targets; ++t) marginal[{t, old[t], event[t]}] += both;
      }
    }
  }
  EventWeights after;
  std::map<std::tuple<std::size_t, std::uint32_t, std::uint32_t>, double> marginal;
  double all = 0;
};

/// Largest difference of the posterior of a target's option before and in the scan.
inline double difference(const MultiscanJpda& jpda, const TwoScans& exact, std::uint32_t points) {
  double largest = 0;
  std::map<std::tuple<std::size_t, std::uint32_t, std::uint32_t>, double> found;
  for (std::size_t t = 0; t < jpda.targets(); ++t) {
    for (std::uint32_t h = 0; h < jpda.hypotheses(t); ++h) {
      for (std::uint32_t o = 0; o <= points; ++o) {
        const double p = jpda.posterior(t)[h * (points + 1) + o];
        const auto place = exact.marginal.find({t, h, o});
        const double other = place == exact.marginal.end() ? 0 : place->second / exact.all;
        largest = std::max(largest, std::abs(p - other));
      }
    }
  }
  return largest;
}

inline MultiscanSettings exactly(bool best_permutation = false) {
  MultiscanSettings settings;
  settings.best_permutation = best_permutation;
  settings.events = 100000, settings.work = 1 << 22, settings.least = 0;
  return settings;
}

inline std::vector<std::uint32_t> apart(const MultiscanJpda& jpda) {
  std::vector<std::uint32_t> merged;
  for (std::size_t t = 0; t < jpda.targets(); ++t) {
    for (std::uint32_t h = 0; h < jpda.hypotheses(t); ++h) merged.push_back(h);
  }
  return merged;
}
inline std::vector<std::uint32_t> together(const MultiscanJpda& jpda) {
  return std::vector<std::uint32_t>(apart(jpda).size(), 0);
}

}  // namespace glint::test

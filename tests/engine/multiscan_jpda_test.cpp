// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/association/multiscan_jpda.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <vector>

namespace glint {
namespace {

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

std::vector<Event> all_events(std::size_t targets, std::size_t points) {
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

double clutter_weight(const JpdaClutter& clutter, std::size_t points, const Event& event) {
  const auto m = static_cast<double>(points);
  const auto d = static_cast<double>(std::ranges::count_if(event, [](auto o) { return o > 0; }));
  if (clutter.number == Number::poisson) return std::pow(clutter.density, m - d);
  return std::tgamma(m - d + 1) / std::tgamma(m + 1) * std::pow(clutter.volume, d - m);
}

double event_weight(const FullScan& scan, const JpdaClutter& clutter, const Event& before,
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
double difference(const MultiscanJpda& jpda, const TwoScans& exact, std::uint32_t points) {
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

MultiscanSettings exactly(bool best_permutation = false) {
  MultiscanSettings settings;
  settings.best_permutation = best_permutation;
  settings.events = 100000, settings.work = 1 << 22, settings.least = 0;
  return settings;
}

std::vector<std::uint32_t> apart(const MultiscanJpda& jpda) {
  std::vector<std::uint32_t> merged;
  for (std::size_t t = 0; t < jpda.targets(); ++t) {
    for (std::uint32_t h = 0; h < jpda.hypotheses(t); ++h) merged.push_back(h);
  }
  return merged;
}
std::vector<std::uint32_t> together(const MultiscanJpda& jpda) {
  return std::vector<std::uint32_t>(apart(jpda).size(), 0);
}

struct Clutter {
  const char* name;
  JpdaClutter clutter;
};
class MultiscanJpdaOf : public testing::TestWithParam<Clutter> {
 protected:
  const JpdaClutter clutter_ = GetParam().clutter;
};
INSTANTIATE_TEST_SUITE_P(Clutter, MultiscanJpdaOf,
                         testing::Values(Clutter{"Poisson", {Number::poisson, 0.3, 1}},
                                         Clutter{"AnyNumber", {Number::any, 1, 7}}),
                         [](const auto& of) { return of.param.name; });

TEST_P(MultiscanJpdaOf, OneScanIsJpda) {
  std::mt19937 random(1);
  const FullScan scan(random, 3, 4, 1);
  MultiscanJpda jpda(exactly());
  for (int t = 0; t < 3; ++t) jpda.add();
  jpda.run(scan.seen(), clutter_);
  const TwoScans exact({{{0, 0, 0}, 1}}, scan, clutter_);
  EXPECT_LT(difference(jpda, exact, 4), 1e-12);
}

TEST_P(MultiscanJpdaOf, TwoScansAreTheSumOverTheirJointEvents) {
  std::mt19937 random(2);
  for (const std::uint32_t points : {0u, 1u, 2u, 3u}) {
    const FullScan first(random, 3, points, 1), second(random, 3, 3, points + 1);
    MultiscanJpda jpda(exactly());
    for (int t = 0; t < 3; ++t) jpda.add();
    const auto seen = first.seen();
    jpda.run(seen, clutter_);
    jpda.advance(apart(jpda), 1);
    jpda.run(second.seen(), clutter_);
    const TwoScans one({{{0, 0, 0}, 1}}, first, clutter_);
    const TwoScans two(one.after, second, clutter_);
    EXPECT_LT(difference(jpda, two, 3), 1e-12) << points;
    for (std::size_t t = 0; t < 3; ++t) EXPECT_EQ(jpda.hypotheses(t), points + 1);
  }
}

TEST_P(MultiscanJpdaOf, ASlidingWindowCarriesTheEventsOfTheLastScan) {
  for (const bool best : {false, true}) {
    std::mt19937 random(3);
    MultiscanJpda jpda(exactly(best));
    for (int t = 0; t < 2; ++t) jpda.add();
    EventWeights events{{{0, 0}, 1}};
    for (int k = 0; k < 4; ++k) {
      const FullScan scan(random, 2, 3, jpda.hypotheses(0));
      ASSERT_EQ(jpda.hypotheses(0), jpda.hypotheses(1));
      const auto seen = scan.seen();
      jpda.run(seen, clutter_);
      const TwoScans exact(events, scan, clutter_, best);
      EXPECT_LT(difference(jpda, exact, 3), 1e-12) << k << best;
      jpda.advance(together(jpda), 1);
      // Hypotheses are numbered by what the target has in the scan, those that cannot be left out.
      events.clear();
      for (const auto& [event, weight] : exact.after) {
        Event numbered;
        for (std::size_t t = 0; t < event.size(); ++t) {
          const auto children = jpda.children(t);
          const auto place = std::ranges::find(children, event[t], &MultiscanJpda::Child::option);
          numbered.push_back(static_cast<std::uint32_t>(place - children.begin()));
        }
        events[numbered] += weight / exact.all;
      }
      if (jpda.hypotheses(0) != jpda.hypotheses(1)) break;
    }
  }
}

TEST(MultiscanJpda, ThreeScansKeepTwoApart) {
  std::mt19937 random(4);
  const JpdaClutter clutter{Number::poisson, 0.3, 1};
  const FullScan first(random, 2, 2, 1), second(random, 2, 2, 3), third(random, 2, 2, 9);
  MultiscanJpda jpda(exactly());
  jpda.add(), jpda.add();
  const auto seen_first = first.seen(), seen_second = second.seen();
  jpda.run(seen_first, clutter), jpda.advance(apart(jpda), 2);
  jpda.run(seen_second, clutter), jpda.advance(apart(jpda), 2);
  ASSERT_EQ(jpda.hypotheses(0), 9u);
  jpda.run(third.seen(), clutter);
  // Brute force: hypothesis 3 a + b.
  EventWeights pairs;
  for (const Event& a : all_events(2, 2)) {
    for (const Event& b : all_events(2, 2)) {
      pairs[{3 * a[0] + b[0], 3 * a[1] + b[1]}] =
          event_weight(first, clutter, {0, 0}, a) * event_weight(second, clutter, a, b);
    }
  }
  EXPECT_LT(difference(jpda, TwoScans(pairs, third, clutter), 2), 1e-12);
}

TEST(MultiscanJpda, OnlyTheLikelierLabelsOfTwoPointsAreKept) {
  const std::vector<std::uint32_t> points{0, 1};
  const std::vector<double> one{-9, 1, 0}, other{-9, 0, 0.5};  // none, first, second
  const std::vector<TargetScan> scan{{points, one}, {points, other}};
  MultiscanJpda jpda(exactly(true));
  jpda.add(), jpda.add();
  jpda.run(scan, {Number::poisson, 0.1, 1});
  EXPECT_EQ(jpda.posterior(0)[2] > 1e-3, false);
  EXPECT_GT(jpda.posterior(0)[1], 0.99);
  EXPECT_GT(jpda.posterior(1)[2], 0.99);
  jpda.advance(together(jpda), 1);
  MultiscanJpda both(exactly(false));
  both.add(), both.add();
  both.run(scan, {Number::poisson, 0.1, 1});
  EXPECT_GT(both.posterior(0)[2], 0.15);
}

TEST(MultiscanJpda, TargetsThatShareNothingAreAlone) {
  const std::vector<std::uint32_t> left{0, 1}, right{2};
  const std::vector<double> a{-2, 0, -1}, b{-2, 0}, b_later{-2, 0, -2, 0};
  MultiscanJpda jpda(exactly());
  jpda.add(), jpda.add(), jpda.add();
  const std::vector<TargetScan> scan{{left, a}, {right, b}, {right, b}};
  EXPECT_EQ(jpda.run(scan, {}).clusters, 2u);
  EXPECT_NEAR(jpda.posterior(0)[1], 1 / (1 + std::exp(-1) + std::exp(-2)), 1e-12);
  jpda.advance(together(jpda), 1);
  const std::vector<std::uint32_t> far{0}, near{1}, none;
  const std::vector<double> missed(3, 0.0);
  std::vector<TargetScan> next{{far, {}}, {near, b_later}, {none, {}}};
  std::vector<double> first(jpda.hypotheses(0) * 2, 0.0), third(jpda.hypotheses(2), 0.0);
  next[0].log_weight = first, next[2].log_weight = third;
  EXPECT_EQ(jpda.run(next, {}).clusters, 2u);  // bound by the scan before
  jpda.advance(together(jpda), 1);
  first.assign(jpda.hypotheses(0), 0.0), third.assign(jpda.hypotheses(2), 0.0);
  std::vector<double> second(jpda.hypotheses(1), 0.0);
  next = {{none, first}, {none, second}, {none, third}};
  EXPECT_EQ(jpda.run(next, {}).clusters, 3u);
}

TEST(MultiscanJpda, ARemovedTargetLeavesTheOthersAsTheyWere) {
  std::mt19937 random(5);
  const FullScan scan(random, 3, 3, 1);
  MultiscanJpda jpda(exactly());
  for (int t = 0; t < 3; ++t) jpda.add();
  const auto seen = scan.seen();
  jpda.run(seen, {});
  jpda.advance(together(jpda), 1);
  std::vector<double> before;
  for (const auto& child : jpda.children(2)) before.push_back(child.probability);
  jpda.remove(1);
  ASSERT_EQ(jpda.targets(), 2u);
  const std::vector<std::uint32_t> none;
  const std::vector<double> certain(4, 0.0);
  jpda.run(std::vector<TargetScan>{{none, certain}, {none, certain}}, {});
  for (std::size_t h = 0; h < before.size(); ++h) {
    EXPECT_NEAR(jpda.posterior(1)[h], before[h], 1e-12);
  }
}

TEST(MultiscanJpda, ACrowdTooLargeForAListIsTakenScanByScan) {
  std::mt19937 random(6);
  MultiscanJpda jpda(MultiscanSettings{});
  for (int t = 0; t < 20; ++t) jpda.add();
  const FullScan scan(random, 20, 60, 1);
  const auto seen = scan.seen();
  EXPECT_EQ(jpda.run(seen, {}).independent, 1u);
  for (std::size_t t = 0; t < 20; ++t) {
    double sum = 0;
    for (const double p : jpda.posterior(t)) sum += p;
    EXPECT_NEAR(sum, 1, 1e-9);
  }
  jpda.advance(together(jpda), 1);
  EXPECT_GT(jpda.hypotheses(0), 10u);
}

TEST(MultiscanJpda, ThePointsLeftOutOfALargeClusterAreTheUnlikely) {
  std::mt19937 random(7);
  MultiscanSettings small = exactly();
  small.work = 200;
  MultiscanJpda trimmed(small), exact(exactly());
  FullScan scan(random, 3, 8, 1);
  for (std::size_t t = 0; t < 3; ++t) {
    trimmed.add(), exact.add();
    for (std::size_t o = 5; o < 9; ++o) scan.log_weight[t][o] -= 9;
  }
  const auto seen = scan.seen();
  EXPECT_EQ(trimmed.run(seen, {}).trimmed, 1u);
  exact.run(seen, {});
  for (std::size_t t = 0; t < 3; ++t) {
    for (std::size_t o = 0; o < 9; ++o) {
      EXPECT_NEAR(trimmed.posterior(t)[o], exact.posterior(t)[o], 2e-3);
    }
  }
}

TEST(MultiscanJpda, TakesNoTargets) {
  MultiscanJpda jpda(MultiscanSettings{});
  EXPECT_EQ(jpda.run({}, {}).clusters, 0u);
  jpda.advance({}, 1);
}

}  // namespace
}  // namespace glint

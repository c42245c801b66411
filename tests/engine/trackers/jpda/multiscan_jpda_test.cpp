// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/jpda/multiscan_jpda.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "multiscan_enumeration.hpp"

namespace glint::test {
namespace {

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

// The last two share a point, and stay together for two scans more.
TEST(MultiscanJpda, TargetsBehindARemovedOneStayBound) {
  const std::vector<std::uint32_t> far{0}, shared{1}, none;
  const std::vector<double> weights{-2, 0};
  MultiscanJpda jpda(exactly());
  jpda.add(), jpda.add(), jpda.add();
  const std::vector<TargetScan> seen{{far, weights}, {shared, weights}, {shared, weights}};
  jpda.run(seen, {});
  jpda.advance(together(jpda), 2);
  jpda.remove(0);
  for (const std::size_t clusters : {1U, 1U, 2U}) {
    const std::vector<double> first(jpda.hypotheses(0)), second(jpda.hypotheses(1));
    const std::vector<TargetScan> unseen{{none, first}, {none, second}};
    EXPECT_EQ(jpda.run(unseen, {}).clusters, clusters);
    jpda.advance(together(jpda), 2);
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
}  // namespace glint::test

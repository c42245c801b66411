// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/jpda/jpda.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <tuple>
#include <vector>

#include "jpda_enumeration.hpp"

namespace glint::test {
namespace {

class JpdaOf : public testing::TestWithParam<Number> {};
INSTANTIATE_TEST_SUITE_P(Clutter, JpdaOf, testing::Values(Number::poisson, Number::any),
                         [](const auto& of) {
                           return of.param == Number::poisson ? "Poisson" : "AnyNumber";
                         });

TEST_P(JpdaOf, IsTheSumOverAllEvents) {
  std::mt19937 random(1);
  Jpda jpda;
  double worst = 0;
  for (int i = 0; i < 400; ++i) {
    const auto targets = static_cast<std::uint32_t>(i % 5);
    const auto points = static_cast<std::uint32_t>(i / 5 % 6);
    const double share = i % 3 == 0 ? 1 : 0.35;  // one cluster, or several
    Case c = random_case(random, targets, points, share, 10);
    c.clutter.number = GetParam();
    const Marginals exact = marginals_of(c, jpda);
    worst = std::max(worst, largest_difference(exact, Enumeration(c).marginals()));
  }
  EXPECT_LT(worst, 1e-12);
}

TEST_P(JpdaOf, EightTargetsAndTenPointsAreTheSumOverAllEvents) {
  std::mt19937 random(2);
  Jpda jpda;
  Case c = random_case(random, 8, 10, 0.4, 8);
  c.clutter.number = GetParam();
  EXPECT_LT(largest_difference(marginals_of(c, jpda), Enumeration(c).marginals()), 1e-12);
}

TEST_P(JpdaOf, MarginalsOfATargetSumToOneAndThoseOfAPointToLess) {
  std::mt19937 random(3);
  Jpda jpda;
  for (int i = 0; i < 20; ++i) {
    Case c = random_case(random, 8, 10, 0.6, 12);
    c.clutter.number = GetParam();
    const Marginals m = marginals_of(c, jpda);
    std::vector<double> target = m.missed, point(10, 0);
    for (std::size_t k = 0; k < c.pairs.size(); ++k) {
      target[c.pairs[k].target] += m.associated[k], point[c.pairs[k].point] += m.associated[k];
    }
    for (const double sum : target) EXPECT_NEAR(sum, 1, 1e-12);
    for (const double sum : point) EXPECT_LT(sum, 1 + 1e-12);
  }
}

TEST_P(JpdaOf, NamesOfTargetsAndPointsDoNotMatter) {
  std::mt19937 random(4);
  Jpda jpda;
  Case c = random_case(random, 6, 9, 0.4, 8);
  c.clutter.number = GetParam();
  Case other = c;
  std::ranges::reverse(other.log_missed);
  for (JpdaPair& pair : other.pairs) pair.target = 5 - pair.target, pair.point = 100 - pair.point;
  std::ranges::reverse(other.pairs);
  Marginals expected = marginals_of(c, jpda);
  std::ranges::reverse(expected.missed), std::ranges::reverse(expected.associated);
  EXPECT_LT(largest_difference(marginals_of(other, jpda), expected), 1e-12);
}

TEST_P(JpdaOf, SameInputGivesTheSameBits) {
  std::mt19937 random(5);
  Jpda one, other;
  Case c = random_case(random, 6, 9, 0.4, 8), large = random_case(random, 12, 12, 0.8, 8);
  c.clutter.number = large.clutter.number = GetParam();
  const Marginals first = marginals_of(c, one);
  marginals_of(large, other);  // leaves its traces in the workspace
  EXPECT_EQ(largest_difference(marginals_of(c, other), first), 0);
}

TEST_P(JpdaOf, WithoutPointsEveryTargetIsMissed) {
  Jpda jpda;
  Case c{{std::log(0.1), std::log(0.2)}, {}, {}};
  c.clutter.number = GetParam();
  EXPECT_EQ(marginals_of(c, jpda).missed, (std::vector<double>{1, 1}));
}

TEST_P(JpdaOf, TakesNoTargets) {
  Jpda jpda;
  Case c;
  c.clutter.number = GetParam();
  EXPECT_TRUE(marginals_of(c, jpda).missed.empty());
  EXPECT_EQ(jpda.run({}, {}, c.clutter).clusters, 0u);
}

TEST_P(JpdaOf, ATargetThatNothingFitsIsMissed) {
  constexpr double kNever = -std::numeric_limits<double>::infinity();
  Jpda jpda;
  Case c{{kNever, std::log(0.2)}, {{0, 0, kNever}, {1, 0, 0}}, {}};
  c.clutter.number = GetParam();
  const Marginals m = marginals_of(c, jpda);
  EXPECT_EQ(m.missed[0], 1);
  EXPECT_EQ(m.associated[0], 0);
  EXPECT_NEAR(m.associated[1], 1 / 1.2, 1e-12);
}

TEST_P(JpdaOf, HundredsOfPointsOverflowNothing) {
  Jpda jpda;
  Case c;
  c.clutter.number = GetParam(), c.clutter.volume = 1e4, c.clutter.density = 0.1;
  for (std::uint32_t t = 0; t < 300; ++t) {
    c.log_missed.push_back(std::log(0.05));
    for (std::uint32_t p = 0; p < 4; ++p) c.pairs.push_back({t, 4 * t + p, std::log(0.05) - p});
  }
  for (const double p : marginals_of(c, jpda).missed) {
    EXPECT_NEAR(p, 0.0595, 0.005);
  }
}

// A target in a crowd that shares one faint point: its weights differ by hundreds of powers of ten.
TEST_P(JpdaOf, SmallWeightsDoNotVanish) {
  Jpda jpda;
  Case c;
  c.clutter.number = GetParam();
  for (std::uint32_t t = 0; t < 60; ++t) {
    c.log_missed.push_back(-40), c.pairs.push_back({t, 0, 0});
  }
  for (const double p : marginals_of(c, jpda).associated) EXPECT_NEAR(p, 1.0 / 60, 1e-12);
}

TEST(Jpda, OneTargetIsThatOfBarShalom) {
  Jpda jpda;
  const Case c{{std::log(0.1)}, {{0, 3, std::log(0.02)}, {0, 5, std::log(0.03)}}, {{}, 0.01, 1}};
  const Marginals m = marginals_of(c, jpda);
  EXPECT_NEAR(m.missed[0], 0.1 / 5.1, 1e-15);
  EXPECT_NEAR(m.associated[1], 3 / 5.1, 1e-15);
}

// Two targets that share no point are coupled by the number of false points alone.
TEST(Jpda, ClustersAreCoupledIfAnyNumberOfFalsePointsIsAsLikely) {
  Jpda jpda;
  Case c{{std::log(0.1), std::log(0.1)}, {{0, 0, 0}, {1, 1, 0}}, {Number::any, 1, 1}};
  const double alone = 1 / 1.2;  // K = 1/2 for one of two points
  // Both, one of them, none: K = 1/2, 1/2, 1.
  const double both = 0.5, one = 0.5 * 0.1, none = 0.01;
  const double p = marginals_of(c, jpda).associated[0];
  EXPECT_NEAR(p, (both + one) / (both + 2 * one + none), 1e-12);
  EXPECT_GT(std::abs(p - alone), 1e-3);
}

TEST_P(JpdaOf, BeliefPropagationIsNearWhereTargetsAreMildlyCoupled) {
  std::mt19937 random(6);
  Jpda exact, loopy(0);
  double worst = 0;
  for (int i = 0; i < 50; ++i) {
    Case c = random_case(random, 5, 8, 0.35, 4);
    c.clutter.number = GetParam(), c.clutter.density = 1, c.clutter.volume = 8;
    const Marginals m = marginals_of(c, loopy);
    worst = std::max(worst, largest_difference(m, marginals_of(c, exact)));
  }
  EXPECT_LT(worst, GetParam() == Number::poisson ? 0.08 : 0.12);
  EXPECT_GT(worst, 0);
}

TEST(Jpda, BeliefPropagationIsExactWithoutCycles) {
  std::mt19937 random(7);
  Jpda exact, loopy(0);
  Case c = random_case(random, 8, 0, 1, 1);
  for (std::uint32_t t = 0; t < 8; ++t) {  // a chain: target t shares point t with the next one
    for (std::uint32_t p = t; p < t + 2; ++p) c.pairs.push_back({t, p, 0.3 * t - 0.2 * p});
  }
  const JpdaReport report = loopy.run(c.log_missed, c.pairs, c.clutter);
  EXPECT_EQ(report.approximate, 1u);
  EXPECT_LT(largest_difference(marginals_of(c, loopy), marginals_of(c, exact)), 1e-9);
}

TEST(Jpda, ReportsWhatItSolvedAndHow) {
  Case c{{-1, -1, -1, -1}, {{0, 0, 0}, {1, 0, 0}, {3, 7, 0}}, {}};
  Jpda exact, loopy(4);  // the pair's table has (2 + 1) 2^1 numbers, the single one's 2 2^1
  JpdaReport report = exact.run(c.log_missed, c.pairs, c.clutter);
  EXPECT_EQ(report.clusters, 2u);
  EXPECT_EQ(report.approximate, 0u);
  EXPECT_EQ(report.largest, 2u);
  report = loopy.run(c.log_missed, c.pairs, c.clutter);
  EXPECT_EQ(report.approximate, 1u);
  EXPECT_GT(report.iterations, 0);
}

TEST_P(JpdaOf, TwentyTargetsInSixtyPointsTakeBeliefPropagation) {
  std::mt19937 random(8);
  Jpda jpda;
  Case c = random_case(random, 20, 60, 0.5, 6);
  c.clutter.number = GetParam(), c.clutter.volume = 60;
  EXPECT_EQ(jpda.run(c.log_missed, c.pairs, c.clutter).approximate, 1u);
  for (const double p : jpda.missed()) EXPECT_TRUE(p > 0 && p < 1) << p;
}

TEST_P(JpdaOf, AThousandTargetsInOneClusterAreSolved) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform;
  Jpda jpda;
  Case c;
  c.clutter.number = GetParam(), c.clutter.density = 0.1, c.clutter.volume = 1e4;
  for (std::uint32_t t = 0; t < 1000; ++t) {
    c.log_missed.push_back(std::log(0.1));
    for (std::uint32_t p = 0; p < 6; ++p) c.pairs.push_back({t, t + p, 2 * uniform(random) - 2});
  }
  const JpdaReport report = jpda.run(c.log_missed, c.pairs, c.clutter);
  EXPECT_EQ(report.largest, 1000u);
  EXPECT_LT(report.iterations, JpdaLoopy::kIterations);
  double sum = 0;
  for (const double p : jpda.missed()) sum += 1 - p;
  for (const double p : jpda.associated()) sum -= p;
  EXPECT_NEAR(sum, 0, 1e-8);
}

}  // namespace
}  // namespace glint::test

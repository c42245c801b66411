// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/jpda/imm_window.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <utility>
#include <vector>

#include "still_targets.hpp"

namespace glint::test {
namespace {

using Sensor = PositionSensor<2>;  // variance 1
using Points = std::vector<Eigen::Vector2d>;
constexpr double kDetectionRate = 0.8, kClutter = 0.01;

ImmWindowConfig window_of(int scans, WindowReading reading) {
  ImmWindowConfig config;
  config.window = scans, config.reading = reading;
  config.detection = kDetectionRate, config.gate = 100;
  return config;
}

/// Targets that stay where they are, their positions known with variance 3.
class Still {
 public:
  Still(const ImmWindowConfig& config, std::initializer_list<double> places) : window(config) {
    for (const double x : places) window.add(still_bank(x, {3}));
  }
  void scan(const Points& points) { window.step(points, Sensor{}, kClutter, 1); }
  Gaussian<4> state(std::size_t target) const { return window.estimate(target).combined(); }
  double x(std::size_t target) const { return state(target).mean(0); }
  double variance(std::size_t target) const { return state(target).covariance(0, 0); }

  ImmWindow<Sensor> window;
};

/// A Kalman filter of a position on the line y = 0, where all points are: one scalar filter an
/// axis.
struct Filter {
  double x, variance, variance_y;
  Filter(double place, double both) : x(place), variance(both), variance_y(both) {}

  Filter updated(double point) const {
    Filter after = *this;
    after.x += variance / (variance + 1) * (point - x);
    after.variance = variance / (variance + 1), after.variance_y = variance_y / (variance_y + 1);
    return after;
  }
  /// How much likelier it is that the point is the target's than that it is clutter and the target
  /// gave none.
  double ratio(double point) const {
    const double off = point - x;
    const double density = std::exp(-off * off / (2 * (variance + 1))) /
                           (2 * std::numbers::pi * std::sqrt((variance + 1) * (variance_y + 1)));
    return kDetectionRate * density / kClutter / (1 - kDetectionRate);
  }
};

/// Mean and variance of a mixture, by weights of any sum.
Filter mixed(const std::vector<Filter>& parts, const std::vector<double>& weights) {
  double sum = 0, mean = 0, square = 0, square_y = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    sum += weights[i], mean += weights[i] * parts[i].x;
    square += weights[i] * (parts[i].variance + parts[i].x * parts[i].x);
    square_y += weights[i] * parts[i].variance_y;
  }
  Filter filter(mean / sum, square / sum - mean * mean / (sum * sum));
  filter.variance_y = square_y / sum;
  return filter;
}

TEST(ImmWindow, TwoTargetsShareAPointByTheirLikelihoods) {
  Still run(window_of(1, WindowReading::best), {0, 3});
  run.scan({{1, 0}});
  const Filter a(0, 3), b(3, 3);
  const double all = 1 + a.ratio(1) + b.ratio(1);
  const double own_a = a.ratio(1) / all, own_b = b.ratio(1) / all;
  EXPECT_EQ(run.window.gated(0).size(), 1u);
  EXPECT_NEAR(run.window.shares(0)[0], own_a, 1e-12);
  EXPECT_NEAR(run.window.shares(1)[0], own_b, 1e-12);
  EXPECT_NEAR(run.window.missed(0), 1 - own_a, 1e-12);
  const Filter first = mixed({a, a.updated(1)}, {1 - own_a, own_a});
  const Filter second = mixed({b, b.updated(1)}, {1 - own_b, own_b});
  EXPECT_NEAR(run.x(0), first.x, 1e-12);
  EXPECT_NEAR(run.x(1), second.x, 1e-12);
  EXPECT_NEAR(run.variance(0), first.variance, 1e-12);
  EXPECT_NEAR(run.variance(1), second.variance, 1e-12);
}

TEST(ImmWindow, PointsBeyondTheGateAreNobodys) {
  ImmWindowConfig config = window_of(1, WindowReading::best);
  config.gate = 9;  // 6 px
  Still run(config, {0, 20});
  run.scan({{19, 0}, {6.1, 0}, {5.9, 0}});
  ASSERT_EQ(run.window.gated(0).size(), 1u);
  EXPECT_EQ(run.window.gated(0)[0], 2u);
  ASSERT_EQ(run.window.gated(1).size(), 1u);
  EXPECT_EQ(run.window.gated(1)[0], 0u);
}

// All that two targets may have had in two scans of one point each: 3 joint events a scan.
TEST(ImmWindow, TwoScansAreWeighedTogether) {
  for (const WindowReading reading : {WindowReading::sliding, WindowReading::restart}) {
    Still run(window_of(2, reading), {0, 3});
    run.scan({{1, 0}}), run.scan({{0.5, 0}});
    const std::array starts{Filter(0, 3), Filter(3, 3)};
    std::array<std::vector<Filter>, 2> parts;
    std::vector<double> weights;
    double all = 0;
    std::array<double, 2> own{};
    for (const std::size_t before : {0u, 1u, 2u}) {  // target + 1 that had the point, 0 for none
      for (const std::size_t now : {0u, 1u, 2u}) {
        double weight = 1;
        std::array<Filter, 2> filter = starts;
        for (const auto& [who, point] : {std::pair{before, 1.0}, std::pair{now, 0.5}}) {
          if (who == 0) continue;
          weight *= filter[who - 1].ratio(point);
          filter[who - 1] = filter[who - 1].updated(point);
        }
        parts[0].push_back(filter[0]), parts[1].push_back(filter[1]);
        weights.push_back(weight), all += weight;
        if (now > 0) own[now - 1] += weight;
      }
    }
    for (const std::size_t t : {0u, 1u}) {
      EXPECT_NEAR(run.window.shares(t)[0], own[t] / all, 1e-12);
      const Filter expected = mixed(parts[t], weights);
      EXPECT_NEAR(run.x(t), expected.x, 1e-12);
      EXPECT_NEAR(run.variance(t), expected.variance, 1e-12);
    }
  }
}

// Hypotheses that differ in the oldest scan alone become one filter, whose moments are theirs; its
// weight is the sum of theirs.
TEST(ImmWindow, ASlidingWindowMergesTheOldestScan) {
  Still run(window_of(2, WindowReading::sliding), {0});
  run.scan({{1, 0}}), run.scan({{0.5, 0}}), run.scan({{2, 0}});
  const Filter start(0, 3), seen = start.updated(1);
  const double had = start.ratio(1);  // the point of the first scan, against 1 for none
  const double found = start.ratio(0.5), had_found = had * seen.ratio(0.5);
  const Filter a = mixed({start, seen}, {1, had});
  const Filter b = mixed({start.updated(0.5), seen.updated(0.5)}, {found, had_found});
  const double weight_a = 1 + had, weight_b = found + had_found;
  const Filter expected = mixed({a, a.updated(2), b, b.updated(2)},
                                {weight_a, weight_a * a.ratio(2), weight_b, weight_b * b.ratio(2)});
  const double none = weight_a + weight_b;
  EXPECT_NEAR(run.window.missed(0), none / (none + weight_a * a.ratio(2) + weight_b * b.ratio(2)),
              1e-12);
  EXPECT_NEAR(run.x(0), expected.x, 1e-12);
  EXPECT_NEAR(run.variance(0), expected.variance, 1e-12);
}

TEST(ImmWindow, ARestartedWindowBeginsWithTheEstimateBeforeIt) {
  Still run(window_of(2, WindowReading::restart), {0, 3});
  run.scan({{1, 0}});
  ImmWindow<Sensor> anew(window_of(2, WindowReading::restart));
  for (const std::size_t t : {0u, 1u}) anew.add(run.window.estimate(t));
  for (const Points& points : {Points{{0.5, 0}}, Points{{2, 0}, {1, 1}}}) {
    run.scan(points), anew.step(points, Sensor{}, kClutter, 1);
  }
  for (const std::size_t t : {0u, 1u}) {
    EXPECT_EQ(run.x(t), anew.estimate(t).combined().mean(0));
    EXPECT_EQ(run.variance(t), anew.estimate(t).combined().covariance(0, 0));
    EXPECT_EQ(run.window.missed(t), anew.missed(t));
  }
}

// A target that is added later enters where it was added, whichever way the window is read.
TEST(ImmWindow, ALaterTargetHasNothingOfEarlierScans) {
  for (const WindowReading reading : {WindowReading::sliding, WindowReading::restart}) {
    Still run(window_of(3, reading), {0}), alone(window_of(3, reading), {});
    run.scan({{1, 0}}), alone.scan({});
    for (Still* each : {&run, &alone}) {
      each->window.add(still_bank(500, {3}));
      EXPECT_EQ(each->x(each->window.targets() - 1), 500);
      each->scan({{501, 0}}), each->scan({{502, 0}});
    }
    EXPECT_NEAR(run.x(1), alone.x(0), 1e-12);
    EXPECT_NEAR(run.variance(1), alone.variance(0), 1e-12);
  }
}

TEST(ImmWindow, ARemovedTargetLeavesTheOthers) {
  for (const WindowReading reading : {WindowReading::sliding, WindowReading::restart}) {
    Still run(window_of(2, reading), {0, 500, 1000}), without(window_of(2, reading), {0, 1000});
    for (Still* each : {&run, &without}) each->scan({{1, 0}, {501, 0}, {1001, 0}});
    run.window.remove(1);
    ASSERT_EQ(run.window.targets(), 2u);
    for (Still* each : {&run, &without}) each->scan({{0.5, 0}, {1000.5, 0}});
    for (const std::size_t t : {0u, 1u}) {
      EXPECT_NEAR(run.x(t), without.x(t), 1e-12);
      EXPECT_NEAR(run.variance(t), without.variance(t), 1e-12);
    }
  }
}

// Each of two targets may have either of two points. Of the two ways in which both have one, the
// best reading counts the likelier alone.
TEST(ImmWindow, TheBestReadingDropsTheOtherPermutation) {
  const auto far_to_near = [](WindowReading reading) {
    Still run(window_of(2, reading), {0, 3});
    run.scan({{0.5, 0}, {2.5, 0}});
    return run.window.shares(0)[1] / run.window.shares(0)[0];
  };
  const Filter a(0, 3), b(3, 3);
  const double near = a.ratio(0.5) * (1 + b.ratio(2.5));
  EXPECT_NEAR(far_to_near(WindowReading::sliding), a.ratio(2.5) * (1 + b.ratio(0.5)) / near, 1e-12);
  EXPECT_NEAR(far_to_near(WindowReading::best), a.ratio(2.5) / near, 1e-12);
}

TEST(ImmWindow, ClutterOfAnyNumberHasTheDensityOfTheGates) {
  ImmWindowConfig config = window_of(1, WindowReading::best);
  config.clutter = JpdaClutter::Number::any, config.gate = 9;
  Still run(config, {0, 500});
  run.scan({{1, 0}});
  // One point in the gates, so K(1) = V with V the sum of both volumes, 9 pi 4 each.
  const double volume = 2 * 9 * std::numbers::pi * 4;
  const double ratio = kDetectionRate * density(1, 4) * volume / (1 - kDetectionRate);
  EXPECT_NEAR(run.window.shares(0)[0], ratio / (1 + ratio), 1e-12);
}

}  // namespace
}  // namespace glint::test

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/metrics/metrics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "glint/engine/metrics/assignment.hpp"
#include "glint/engine/metrics/evaluation.hpp"
#include "glint/kernels/core/random.hpp"

namespace glint {
namespace {

double draw(std::uint32_t trial, std::uint32_t item) {
  return uniform(random_words(random_key(11, trial, Purpose::trial), item).w[0]);
}

std::vector<Position> random_set(std::uint32_t trial, std::size_t size) {
  std::vector<Position> set;
  for (std::uint32_t i = 0; i < size; ++i) {
    set.push_back({12 * draw(trial, 2 * i), 12 * draw(trial, 2 * i + 1)});
  }
  return set;
}

double cost_of(const Eigen::MatrixXd& costs, const std::vector<int>& partner) {
  double sum = 0;
  for (std::size_t i = 0; i < partner.size(); ++i) {
    if (partner[i] >= 0) sum += costs(static_cast<Eigen::Index>(i), partner[i]);
  }
  return sum;
}

/// Least cost over all permutations of the longer side.
double cheapest(const Eigen::MatrixXd& costs) {
  if (costs.rows() > costs.cols()) return cheapest(costs.transpose());
  std::vector<int> order(static_cast<std::size_t>(costs.cols()));
  std::iota(order.begin(), order.end(), 0);
  double best = INFINITY;
  do {
    double sum = 0;
    for (Eigen::Index r = 0; r < costs.rows(); ++r)
      sum += costs(r, order[static_cast<std::size_t>(r)]);
    best = std::min(best, sum);
  } while (std::next_permutation(order.begin(), order.end()));
  return best;
}

TEST(Assignment, MatchesBruteForceOnEveryShape) {
  std::uint32_t trial = 0;
  for (int rows = 1; rows <= 6; ++rows) {
    for (int columns = 1; columns <= 6; ++columns) {
      for (int repeat = 0; repeat < 5; ++repeat, ++trial) {
        Eigen::MatrixXd costs(rows, columns);
        for (int i = 0; i < costs.size(); ++i) {
          costs(i) = std::floor(9 * draw(trial, static_cast<std::uint32_t>(i))) - 4;  // many ties
        }
        const std::vector<int> partner = assign_least_cost(costs);
        std::vector<int> used;
        std::copy_if(partner.begin(), partner.end(), std::back_inserter(used),
                     [](int c) { return c >= 0; });
        std::sort(used.begin(), used.end());
        EXPECT_EQ(static_cast<int>(used.size()), std::min(rows, columns));
        EXPECT_EQ(std::adjacent_find(used.begin(), used.end()), used.end());
        EXPECT_DOUBLE_EQ(cost_of(costs, partner), cheapest(costs)) << rows << "x" << columns;
      }
    }
  }
}

TEST(Assignment, OfNothingIsEmpty) {
  EXPECT_TRUE(assign_least_cost(Eigen::MatrixXd(0, 3)).empty());
  EXPECT_EQ(assign_least_cost(Eigen::MatrixXd(2, 0)), (std::vector<int>{-1, -1}));
}

TEST(OspaMetric, HasKnownValues) {
  const std::vector<Position> one{{0, 0}}, near{{3, 0}}, pair{{3, 0}, {100, 0}}, none;
  EXPECT_DOUBLE_EQ(ospa(one, near, 5, 2).distance, 3);
  EXPECT_DOUBLE_EQ(ospa(none, none, 5, 2).distance, 0);
  EXPECT_DOUBLE_EQ(ospa(one, none, 5, 2).distance, 5);
  const Ospa extra = ospa(one, pair, 5, 2);
  EXPECT_DOUBLE_EQ(extra.distance, std::sqrt((9 + 25) / 2.0));
  EXPECT_DOUBLE_EQ(extra.localisation, std::sqrt(9 / 2.0));
  EXPECT_DOUBLE_EQ(extra.cardinality, std::sqrt(25 / 2.0));
  EXPECT_DOUBLE_EQ(ospa(one, pair, 5, 1).distance, (3 + 5) / 2.0);
}

TEST(OspaMetric, ObeysTheAxiomsOfAMetric) {
  for (std::uint32_t trial = 0; trial < 300; ++trial) {
    const auto a = random_set(3 * trial, trial % 5);
    const auto b = random_set(3 * trial + 1, trial / 5 % 5);
    const auto c = random_set(3 * trial + 2, trial / 25 % 5);
    const double ab = ospa(a, b, 5, 2).distance;
    EXPECT_EQ(ospa(a, a, 5, 2).distance, 0);
    EXPECT_NEAR(ab, ospa(b, a, 5, 2).distance, 1e-12);
    EXPECT_LE(ospa(a, c, 5, 2).distance, ab + ospa(b, c, 5, 2).distance + 1e-12);
    EXPECT_LE(ab, 5);
    auto shuffled = b;
    std::reverse(shuffled.begin(), shuffled.end());
    EXPECT_NEAR(ospa(a, shuffled, 5, 2).distance, ab, 1e-12);
  }
}

TEST(GospaMetric, SplitsIntoItsParts) {
  const std::vector<Position> truth{{0, 0}, {50, 0}}, said{{3, 0}, {80, 0}, {90, 0}};
  const Gospa g = gospa(truth, said, 5, 2);
  EXPECT_DOUBLE_EQ(g.localisation, 3);
  EXPECT_DOUBLE_EQ(g.missed, std::sqrt(25 / 2.0));
  EXPECT_DOUBLE_EQ(g.false_alarms, 5);
  EXPECT_DOUBLE_EQ(g.distance, std::sqrt(9 + 12.5 + 25));
}

TEST(GospaMetric, ObeysTheAxiomsOfAMetric) {
  for (std::uint32_t trial = 0; trial < 300; ++trial) {
    const auto a = random_set(3 * trial, trial % 5);
    const auto b = random_set(3 * trial + 1, trial / 5 % 5);
    const auto c = random_set(3 * trial + 2, trial / 25 % 5);
    const double ab = gospa(a, b, 5, 2).distance;
    EXPECT_EQ(gospa(a, a, 5, 2).distance, 0);
    EXPECT_NEAR(ab, gospa(b, a, 5, 2).distance, 1e-12);
    EXPECT_LE(gospa(a, c, 5, 2).distance, ab + gospa(b, c, 5, 2).distance + 1e-12);
  }
}

TEST(Metrics, CountUnknownPositionsAsOutOfReach) {
  const std::vector<Position> truth{{1, 1}}, said{{NAN, 1}};
  EXPECT_DOUBLE_EQ(ospa(truth, said, 5, 2).distance, 5);
  EXPECT_TRUE(match(truth, said, 5, 2).empty());
}

TEST(Metrics, RefuseAnAbsurdCutoffOrOrder) {
  EXPECT_THROW(ospa({}, {}, 0, 2), std::invalid_argument);
  EXPECT_THROW(gospa({}, {}, 5, 0.5), std::invalid_argument);
}

TruthPoint truth_at(std::int64_t frame, std::int64_t id, double x) {
  return {.frame = frame, .track_id = id, .x = x, .y = 0};
}

TrackPoint said_at(std::int64_t frame, std::int64_t id, double x,
                   TrackStatus status = TrackStatus::confirmed) {
  TrackPoint p;
  p.frame = frame, p.track_id = id, p.x = x, p.y = 0, p.status = status;
  return p;
}

/// Target 0 in frames 2..7 at x = frame; target 1 in frames 0..9 at x = 100, never found.
std::vector<TruthPoint> two_truths() {
  std::vector<TruthPoint> truth;
  for (int k = 0; k < 10; ++k) {
    if (k >= 2 && k < 8) truth.push_back(truth_at(k, 0, k));
    truth.push_back(truth_at(k, 1, 100));
  }
  return truth;
}

TEST(Evaluation, FollowsATrackThroughItsLife) {
  std::vector<TrackPoint> tracks;
  for (int k = 4; k < 10; ++k) tracks.push_back(said_at(k, 7, k + 1.0));
  tracks.push_back(said_at(3, 7, 3, TrackStatus::tentative));
  tracks.push_back(said_at(5, 9, 50));
  const Evaluation e = evaluate(two_truths(), tracks);
  ASSERT_EQ(e.ospa.size(), 10u);
  const TruthScore& found = e.truths.at(0);
  EXPECT_DOUBLE_EQ(found.rmse, 1);
  EXPECT_DOUBLE_EQ(found.detect_delay, 2);
  EXPECT_DOUBLE_EQ(found.halt_delay, 2);
  EXPECT_TRUE(found.detected);
  EXPECT_EQ(found.identities, 1);
  EXPECT_TRUE(std::isnan(e.truths.at(1).rmse));
  EXPECT_TRUE(std::isnan(e.truths.at(1).detect_delay));
  EXPECT_TRUE(std::isnan(e.truths.at(1).halt_delay));
  EXPECT_EQ(e.tracks, 2);
  EXPECT_EQ(e.false_tracks, 1);
  EXPECT_DOUBLE_EQ(e.track_detection_probability, 0.5);
  EXPECT_DOUBLE_EQ(e.detected_points, 4.0 / 16);
  EXPECT_DOUBLE_EQ(e.false_points_per_frame, 3.0 / 10);  // two after the death, one stray
  EXPECT_DOUBLE_EQ(e.identities_per_truth, 1);
  EXPECT_DOUBLE_EQ(e.mean_cardinality_error, (1 + 1 + 2 + 2 + 1 + 0 + 1 + 1 + 0 + 0) / 10.0);
}

TEST(Evaluation, ScoresTentativePointsOnDemandAndHaltedOnesNever) {
  const std::vector<TrackPoint> tracks{said_at(2, 7, 2, TrackStatus::tentative),
                                       said_at(3, 7, 3, TrackStatus::halted)};
  EXPECT_DOUBLE_EQ(evaluate(two_truths(), tracks).detected_points, 0);
  EvaluationOptions all;
  all.include_tentative = true;
  EXPECT_DOUBLE_EQ(evaluate(two_truths(), tracks, all).detected_points, 1.0 / 16);
  TrackPoint doubted = tracks[0];
  doubted.existence = 0.49;
  EXPECT_DOUBLE_EQ(evaluate(two_truths(), std::vector{doubted}, all).detected_points, 0);
  doubted.existence = 0.5;
  EXPECT_DOUBLE_EQ(evaluate(two_truths(), std::vector{doubted}, all).detected_points, 1.0 / 16);
}

TEST(Evaluation, CountsATrackOnlyIfHalfOfItIsNear) {
  const std::vector<TruthPoint> truth{truth_at(0, 0, 0), truth_at(1, 0, 0), truth_at(2, 0, 0)};
  const std::vector<TrackPoint> half{said_at(0, 1, 0), said_at(1, 1, 50)};
  EXPECT_EQ(evaluate(truth, half).false_tracks, 0);
  const std::vector<TrackPoint> third{said_at(0, 1, 0), said_at(1, 1, 50), said_at(2, 1, 50)};
  EXPECT_EQ(evaluate(truth, third).false_tracks, 1);
  EXPECT_EQ(evaluate(truth, third).detected_truths, 0);
}

TEST(Evaluation, DoesNotDependOnLabelsOrOrder) {
  std::vector<TrackPoint> tracks;
  for (int k = 0; k < 10; ++k) tracks.push_back(said_at(k, k < 5 ? 3 : 4, k + 0.5));
  for (int k = 0; k < 10; ++k) tracks.push_back(said_at(k, 5, 101));
  const Evaluation before = evaluate(two_truths(), tracks);
  for (TrackPoint& p : tracks) p.track_id = 10 - p.track_id;
  std::stable_sort(tracks.begin(), tracks.end(),
                   [](const auto& a, const auto& b) { return a.frame > b.frame; });
  std::reverse(tracks.begin(), tracks.end());
  const Evaluation after = evaluate(two_truths(), tracks);
  EXPECT_EQ(before.mean_ospa.distance, after.mean_ospa.distance);
  EXPECT_EQ(before.mean_gospa.distance, after.mean_gospa.distance);
  EXPECT_EQ(before.truths.at(0).identities, 2);
  EXPECT_EQ(after.truths.at(0).identities, 2);
  EXPECT_EQ(before.false_tracks, after.false_tracks);
  EXPECT_EQ(before.detected_points, after.detected_points);
}

TEST(Evaluation, OfNothingIsUndefinedWhereItMustBe) {
  const Evaluation e = evaluate({}, {});
  EXPECT_TRUE(e.ospa.empty());
  EXPECT_TRUE(std::isnan(e.track_detection_probability));
  EXPECT_TRUE(std::isnan(e.detected_points));
  EXPECT_TRUE(std::isnan(e.false_points_per_frame));
}

TEST(Evaluation, RefusesFramesThatNoMemoryHolds) {
  const std::vector<TruthPoint> far{{1'000'000'000'000, 0, 1, 1}};
  EXPECT_THROW(evaluate(far, {}, {}), std::invalid_argument);
  EvaluationOptions negative;
  negative.frames = -3;
  EXPECT_THROW(evaluate({}, {}, negative), std::invalid_argument);
}

TEST(DetectorBaseline, FindsTheLowestFairThreshold) {
  const std::vector<TruthPoint> truth{truth_at(0, 0, 0), truth_at(1, 0, 0), truth_at(2, 0, 0)};
  const std::vector<Detection> detections{{0, 0, 0, 9},  {1, 50, 0, 8}, {1, 0, 0, 7},
                                          {2, 60, 0, 6}, {2, 0, 0, 5},  {2, 70, 0, 4}};
  const Baseline none = detector_baseline(truth, detections, 0);
  EXPECT_DOUBLE_EQ(none.threshold, 9);
  EXPECT_DOUBLE_EQ(none.detected_points, 1.0 / 3);
  const Baseline one = detector_baseline(truth, detections, 1.0 / 3);
  EXPECT_DOUBLE_EQ(one.threshold, 7);
  EXPECT_DOUBLE_EQ(one.detected_points, 2.0 / 3);
  EXPECT_DOUBLE_EQ(one.false_points_per_frame, 1.0 / 3);
  EXPECT_DOUBLE_EQ(detector_baseline(truth, detections, 10).threshold, 4);
  EXPECT_TRUE(std::isnan(detector_baseline(truth, {}, 1).threshold));
}

}  // namespace
}  // namespace glint

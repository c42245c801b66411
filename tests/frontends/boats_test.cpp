// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "cli.hpp"
#include "glint/frontends/experiments/boat_run.hpp"

namespace glint {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

/// Two boats 60 m apart on parallel courses, seen exactly every two seconds from a ship at rest.
BoatRecord two_boats(int scans) {
  BoatRecord record;
  for (int i = 0; i < scans; ++i) {
    BoatScan scan{2.0 * i, {10, -20}, {}};
    for (int boat = 0; boat < 2; ++boat) {
      TruthPoint t{.frame = i, .track_id = boat + 1, .x = 8.0 * i, .y = 60.0 * boat + 40};
      t.vx = 4, t.vy = 0, t.intensity = 1;
      record.truth.push_back(t);
      scan.points.push_back({t.x, t.y});
    }
    record.scans.push_back(scan);
  }
  return record;
}

ImmJpdaConfig config(bool initiate) {
  ImmJpdaConfig c;
  c.clock = TimeUnit::seconds, c.measurement_variance = 25, c.clutter_density = 5e-6;
  c.position_sd = 8, c.speed_max = 15, c.separation = 10;
  c.initiate = initiate;
  c.life.confirm_existence = 0;
  return c;
}

TEST(Boats, KnownStartsAreFollowedToTheEnd) {
  const BoatScore score = follow_boats(two_boats(20), config(false), kFar);
  EXPECT_EQ(score.lost, 0);
  EXPECT_EQ(score.swapped, 0);
  EXPECT_LT(score.scores.mean_ospa.distance, 0.1);
  EXPECT_EQ(score.coverage.at(1).any, 1);
  EXPECT_EQ(score.coverage.at(2).one, 1);
}

TEST(Boats, OwnStartsAreThereFromTheirSecondScanOn) {
  const BoatScore score = follow_boats(two_boats(20), config(true), kFar);
  EXPECT_NEAR(score.coverage.at(1).one, 0.95, 1e-9);
  EXPECT_EQ(score.scores.truths.at(1).detect_delay, 2);
  EXPECT_EQ(score.scores.false_tracks, 0);
}

TEST(Boats, AreConfirmedAsSoonAsTheirEchoesAllow) {
  constexpr HitLogic kThreeOfFour{.confirm_hits = 3, .confirm_window = 4};
  BoatRecord record = two_boats(12);
  EXPECT_EQ(confirmable_at(record, 2, kThreeOfFour, 30), 3);
  // Boat 2 gives echoes at scans 2, 4, 5 and 7 alone: 2 and 4 are not in a row, 4 to 7 are four.
  for (const std::size_t silent : {0, 2, 5, 7, 8, 9, 10, 11}) {
    record.scans[silent].points.pop_back();
  }
  EXPECT_EQ(confirmable_at(record, 1, kThreeOfFour, 30), 3);
  EXPECT_EQ(confirmable_at(record, 2, kThreeOfFour, 30), 7);
  EXPECT_TRUE(std::isnan(confirmable_at(record, 2, {.confirm_hits = 4, .confirm_window = 4}, 30)));
  EXPECT_EQ(confirmable_at(record, 2, kThreeOfFour, 61), 3);  // boat 1's are as near
  ImmJpdaConfig own = config(true);
  own.life.halt_existence = 0;
  const BoatScore score = follow_boats(record, own, kFar);
  EXPECT_EQ(score.confirmed.at(1), 3);
  EXPECT_EQ(score.confirmed.at(2), 7);
}

TEST(Boats, ABoatWithoutPointsIsLost) {
  BoatRecord record = two_boats(20);
  for (std::size_t i = 6; i < record.scans.size(); ++i) record.scans[i].points.pop_back();
  for (TruthPoint& t : record.truth) {
    if (t.frame >= 6 && t.track_id == 2) t.y += 10 * double(t.frame - 6);  // turns away
  }
  const BoatScore score = follow_boats(record, config(false), kFar);
  EXPECT_EQ(score.lost, 1);
  EXPECT_EQ(score.swapped, 0);
}

TEST(Boats, BoatsThatChangePlacesUnseenAreSwapped) {
  BoatRecord record = two_boats(20);
  for (TruthPoint& t : record.truth) {
    if (t.frame >= 10) t.track_id = 3 - t.track_id;
  }
  std::ranges::stable_sort(record.truth, {}, [](const TruthPoint& t) {
    return std::pair{t.frame, t.track_id};
  });
  EXPECT_EQ(follow_boats(record, config(false), kFar).swapped, 2);
}

TEST(Boats, RangeAndAzimuthTellWhatPositionsTell) {
  ImmJpdaConfig polar = config(false);
  polar.measurement = MeasuredQuantity::range_azimuth, polar.range_sd = 5, polar.azimuth_sd = 0.05;
  const BoatScore score = follow_boats(two_boats(20), polar, kFar);
  EXPECT_EQ(score.lost, 0);
  EXPECT_LT(score.scores.mean_ospa.distance, 0.1);
}

TEST(Boats, BeyondReachThereIsNothing) {
  BoatTrial trial;
  trial.reach = 100;
  const BoatRecord record = changed(two_boats(30), trial);
  for (const TruthPoint& t : record.truth) EXPECT_LE(std::hypot(t.x - 10, t.y + 20), 100);
  EXPECT_LT(record.truth.size(), 60U);
  EXPECT_GT(record.truth.size(), 5U);
  EXPECT_TRUE(record.scans.back().points.empty());
}

TEST(Boats, PointsAreThinnedAndAddedAsAsked) {
  BoatTrial trial;
  trial.keep = 0.7, trial.clutter = 3e-4;
  const BoatRecord whole = two_boats(200);
  const double area = (8 * 199 + 120) * (60 + 120.0);
  const BoatRecord record = changed(whole, trial);
  double kept = 0, added = 0;
  for (std::size_t i = 0; i < 200; ++i) {
    for (const Position& p : record.scans[i].points) {
      const bool real = std::ranges::any_of(
          whole.scans[i].points, [&](const Position& q) { return p.x == q.x && p.y == q.y; });
      real ? ++kept : ++added;
    }
  }
  EXPECT_NEAR(kept / 400, 0.7, 4 * std::sqrt(0.21 / 400));
  EXPECT_NEAR(added / 200, 3e-4 * area, 4 * std::sqrt(3e-4 * area / 200));
  EXPECT_EQ(changed(whole, trial).scans[7].points.size(), record.scans[7].points.size());
  EXPECT_EQ(record.truth, whole.truth);
}

TEST(Boats, TheExperimentSaysWhatItNeeds) {
  const test::Folder folder;
  test::expect_error(test::glint(folder, "experiment jpda-boats"), 2, "--data");
  test::expect_error(test::glint(folder, "experiment jpda-boats-stress --data " + folder.path()), 2,
                     "scenario2_detections.json");
}

}  // namespace
}  // namespace glint

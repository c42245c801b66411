// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/metrics/consistency.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace glint {
namespace {

/// A confirmed point of frame 0 that is `x`, `y` [px] away from the truth of the same frame.
TrackPoint off(double x, double y) {
  TrackPoint p;
  p.status = TrackStatus::confirmed;
  p.x = 50 + x, p.y = 20 + y;
  return p;
}

const std::vector<TruthPoint> kTruth{{0, 1, 50, 20, 3, -4, NAN}};

TrackPoint with(TrackPoint p, const StateCovariance& c) {
  p.set_covariance(c);
  return p;
}

Consistency of(const std::vector<TrackPoint>& tracks) { return consistency(kTruth, tracks); }

// P = (4 1; 1 2), its inverse (2 -1; -1 4) / 7: e = (1, 2) gives (2 - 4 + 16) / 7.
TEST(Consistency, PositionIsWeighedByTheInverseOfItsCovariance) {
  TrackPoint p = off(1, 2);
  p.var_x = 4, p.cov_xy = 1, p.var_y = 2;
  const Consistency one = of({p});
  EXPECT_NEAR(one.position_nees.sum, 2, 1e-12);
  EXPECT_EQ(one.position_nees.points, 1);
  EXPECT_EQ(one.state_nees.points, 0);  // no covariance of the velocity
  p.x = 50 - 1;                         // (2 + 4 + 16) / 7
  EXPECT_NEAR(of({p}).position_nees.mean(), 22.0 / 7, 1e-12);
  EXPECT_NEAR(of({off(0, 0), p, p}).position_nees.mean(), 22.0 / 7, 1e-12);
}

// P = L L' with L = (1; 1 1; 2 1 1; 1 3 3 1), so that e' P^-1 e = |L^-1 e|^2. For e = L (1, 2, 3,
// 4) that is 1 + 4 + 9 + 16.
TEST(Consistency, StateIsWeighedByAllOfItsCovariance) {
  const StateCovariance c{1, 1, 2, 2, 1, 3, 4, 6, 8, 20};
  TrackPoint p = with(off(1, 3), c);
  p.vx = 3 + 7, p.vy = -4 + 20;
  const Consistency found = consistency(kTruth, std::vector{p}, 4);
  EXPECT_EQ(found.state_nees.points, 1);
  EXPECT_NEAR(found.state_nees.sum, 30, 1e-9);
  EXPECT_NEAR(found.position_nees.sum, 1 + 4, 1e-12);
  std::vector<TruthPoint> unknown_speed = kTruth;
  unknown_speed[0].vx = NAN;
  const Consistency placed = consistency(unknown_speed, std::vector{p}, 4);
  EXPECT_EQ(placed.state_nees.points, 0);
  EXPECT_EQ(placed.position_nees.points, 1);
}

TEST(Consistency, ASingularCovarianceIsLeftOut) {
  EXPECT_EQ(of({with(off(1, 1), StateCovariance::zero())}).position_nees.points, 0);
  StateCovariance c{1, 0, 1, 1, 0, 0, 0, 1, 0, 1};  // x and vx are one and the same
  TrackPoint p = with(off(1, 1), c);
  p.vx = 3, p.vy = -4;
  EXPECT_EQ(of({p}).position_nees.points, 1);
  EXPECT_EQ(of({p}).state_nees.points, 0);
}

TEST(Consistency, ATruthCountsWithinReachAndTheNearestDoes) {
  TrackPoint p = off(3, 0);
  p.var_x = p.var_y = 1, p.cov_xy = 0, p.existence = 0.75;
  EXPECT_EQ(of({p}).position_nees.points, 1);
  EXPECT_NEAR(of({p}).brier(), 0.25 * 0.25, 1e-12);
  p.x += 0.01;
  EXPECT_EQ(of({p}).position_nees.points, 0);
  EXPECT_EQ(of({p}).real, 0);
  EXPECT_NEAR(of({p}).brier(), 0.75 * 0.75, 1e-12);
  EXPECT_EQ(consistency(kTruth, std::vector{p}, 4).position_nees.points, 1);
  const std::vector<TruthPoint> two{{0, 1, 50, 20}, {0, 2, 54, 20}, {0, 3, 51, 20}, {1, 4, 53, 20}};
  EXPECT_NEAR(consistency(two, std::vector{p}, 4).position_nees.sum, 0.99 * 0.99, 1e-9);
}

TEST(Consistency, TentativeAndHaltedPointsCountForTheirExistenceAlone) {
  TrackPoint p = off(1, 0);
  p.var_x = p.var_y = 1, p.cov_xy = 0, p.existence = 0.5;
  p.status = TrackStatus::tentative;
  EXPECT_EQ(of({p}).position_nees.points, 0);
  EXPECT_EQ(of({p}).existence_error.points, 1);
  p.status = TrackStatus::halted;
  EXPECT_EQ(of({p}).position_nees.points, 0);
  EXPECT_EQ(of({p}).existence_error.points, 1);
}

TEST(Consistency, BrierStandsBesideThatOfTheBaseRate) {
  TrackPoint real = off(0, 0), none = off(30, 0), silent = off(0, 0);
  real.existence = 0.9, none.existence = 0.3;
  const Consistency found = of({real, none, none, none, silent});
  EXPECT_EQ(found.existence_error.points, 4);  // the silent one states nothing
  EXPECT_EQ(found.real, 1);
  EXPECT_NEAR(found.brier(), (0.1 * 0.1 + 3 * 0.3 * 0.3) / 4, 1e-12);
  EXPECT_NEAR(found.brier_of_base_rate(), 0.25 * 0.75, 1e-12);
  EXPECT_TRUE(std::isnan(of({}).brier()));
  EXPECT_TRUE(std::isnan(of({}).brier_of_base_rate()));
}

TEST(Consistency, FramesBeyondTheLastAreLeftOut) {
  TrackPoint p = off(0, 0);
  p.existence = 1;
  TrackPoint late = p;
  late.frame = 5;
  const std::vector both{p, late};
  EXPECT_EQ(consistency(kTruth, both).existence_error.points, 2);
  EXPECT_EQ(consistency(kTruth, both, 3, 5).existence_error.points, 1);
  EXPECT_EQ(consistency(kTruth, both, 3, 6).existence_error.points, 2);
  late.frame = -1;
  EXPECT_THROW(consistency(kTruth, std::vector{p, late}), std::invalid_argument);
}

}  // namespace
}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/tracks/scan_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace glint {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Scan scan_of(const std::vector<PointMeasurement>& points) {
  Scan scan;
  scan.points = points;
  return scan;
}

TEST(ScanPoints, AreThoseWhosePlaceIsKnown) {
  const std::vector<PointMeasurement> points{{1, 2, 5}, {kNan, 2, 5}, {3, kNan, 5}, {4, 6, kNan}};
  ScanPoints taken;
  taken.take(scan_of(points));
  ASSERT_EQ(taken.positions.size(), 2u);
  EXPECT_EQ(taken.positions[0], Eigen::Vector2d(1, 2));
  EXPECT_EQ(taken.positions[1], Eigen::Vector2d(4, 6));
  EXPECT_EQ(taken.amplitudes[0], 5);
  EXPECT_TRUE(std::isnan(taken.amplitudes[1]));
}

TEST(ScanPoints, AreFreeUntilHalfOfThemIsClaimed) {
  const std::vector<PointMeasurement> points{{1, 2, 5}, {3, 2, 5}};
  ScanPoints taken;
  taken.take(scan_of(points));
  taken.claimed[0] = 0.49, taken.claimed[1] = 0.5;
  EXPECT_TRUE(taken.free(0));
  EXPECT_FALSE(taken.free(1));
  taken.take(scan_of(points));
  EXPECT_TRUE(taken.free(1));
}

TEST(ScanPoints, CanBeAddedOneByOne) {
  ScanPoints added;
  added.take(scan_of({{9, 9, 1}}));
  added.clear();
  added.add({1, 2}, 5), added.add({3, 4}, 6);
  ASSERT_EQ(added.positions.size(), 2u);
  EXPECT_EQ(added.positions[0], Eigen::Vector2d(1, 2));
  EXPECT_EQ(added.amplitudes[1], 6);
  EXPECT_TRUE(added.free(0));
}

// Without a frame the area is that of the box about all points of all scans.
TEST(ScanPoints, FalseOnesAreThoseBeyondOneATarget) {
  ScanPoints taken;
  taken.take(scan_of({{0, 0, 1}, {10, 20, 1}}));
  taken.take(scan_of({{1, 1, 1}, {2, 2, 1}, {3, 3, 1}, {4, 4, 1}, {5, 5, 1}}));
  EXPECT_DOUBLE_EQ(taken.false_density(2, 9), 3.0 / 200);
  EXPECT_DOUBLE_EQ(taken.false_density(9, 9), 1.0 / 200);
  EXPECT_DOUBLE_EQ(taken.false_density(2, 9, 5), 3.0 / (20 * 30));
}

TEST(ScanPoints, LieInAnAreaEvenIfAllInOnePlace) {
  ScanPoints taken;
  EXPECT_EQ(taken.area.size(0.25), 0.25);
  taken.take(scan_of({{500000, 5000000, 1}, {500003, 5000000, 1}}));
  EXPECT_EQ(taken.area.size(0.25), 0.25);
  EXPECT_EQ(taken.area.size(0.25, 1), 5 * 2);
  EXPECT_EQ(taken.false_density(0, 0.25), 2 / 0.25);
}

}  // namespace
}  // namespace glint

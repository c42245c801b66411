// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/jpda/validation_gate.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

namespace glint {
namespace {

using Sensor = PositionSensor<2>;
constexpr double kGate = 9;  // 3 sigma

/// Expects (x, 0) with these variances of the innovation.
template <int N>
ModelPrediction<Sensor, N> expecting(double x, double variance_x, double variance_y) {
  return {{x, 0},
          Eigen::Vector2d(variance_x, variance_y).asDiagonal(),
          Eigen::Matrix<double, N, 2>::Zero()};
}

std::vector<bool> inside(const ValidationGate<Sensor>& gate, std::size_t points) {
  std::vector<bool> holds;
  for (std::size_t i = 0; i < points; ++i) holds.push_back(gate.holds(i));
  return holds;
}

TEST(ValidationGate, IsAnEllipseOfTheInnovationsSpread) {
  const std::vector<Eigen::Vector2d> points{{7, 0}, {7.01, 0}, {1, 3}, {1, 3.01}, {-5, 0}};
  ValidationGate<Sensor> gate(kGate);
  gate.reset(points.size());
  gate.add({expecting<4>(1, 4, 1)}, points);
  EXPECT_EQ(inside(gate, points.size()), (std::vector{true, false, true, false, true}));
  EXPECT_NEAR(gate.volume(), std::numbers::pi * 6 * 3, 1e-9);  // P-JPDA (26): half axes 6 and 3
}

TEST(ValidationGate, IsTheUnionOverModelsAndHypotheses) {
  const std::vector<Eigen::Vector2d> points{{6, 0}, {0, 6}, {26, 0}, {0, 7}, {14, 0}};
  ValidationGate<Sensor> gate(kGate);
  gate.reset(points.size());
  gate.add({expecting<4>(0, 4, 1), expecting<6>(0, 1, 4)}, points);
  EXPECT_EQ(inside(gate, points.size()), (std::vector{true, true, false, false, false}));
  gate.add({expecting<4>(20, 4, 1)}, points);
  EXPECT_EQ(inside(gate, points.size()), (std::vector{true, true, true, false, true}));
}

TEST(ValidationGate, HasTheVolumeOfItsLargestPart) {
  ValidationGate<Sensor> gate(kGate);
  gate.reset(0);
  gate.add({expecting<4>(0, 4, 1), expecting<6>(0, 4, 9)}, {});
  gate.add({expecting<4>(50, 1, 1)}, {});
  EXPECT_NEAR(gate.volume(), std::numbers::pi * 6 * 9, 1e-9);
}

TEST(ValidationGate, BeginsAnewForTheNextTarget) {
  const std::vector<Eigen::Vector2d> points{{0, 0}, {30, 0}};
  ValidationGate<Sensor> gate(kGate);
  gate.reset(points.size());
  gate.add({expecting<4>(0, 4, 4)}, points);
  gate.reset(points.size());
  gate.add({expecting<4>(30, 1, 1)}, points);
  EXPECT_EQ(inside(gate, points.size()), (std::vector{false, true}));
  EXPECT_NEAR(gate.volume(), std::numbers::pi * 9, 1e-9);
}

}  // namespace
}  // namespace glint

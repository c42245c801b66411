// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/h_pmht/rts_smoother.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace glint {
namespace {

AxisBelief wide_prior() {
  AxisBelief prior;
  prior.mean << 3, -0.5;
  prior.covariance << 4, 1, 1, 2;
  return prior;
}

/// Information matrix and vector of all states at once: every term of the posterior's exponent.
struct LeastSquares {
  Eigen::MatrixXd information;
  Eigen::VectorXd vector;
};

LeastSquares stack(const AxisBelief& prior, const std::vector<AxisScan>& scans) {
  const auto size = static_cast<Eigen::Index>(2 * (scans.size() + 1));
  LeastSquares all{Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd::Zero(size)};
  const Eigen::Matrix2d first = prior.covariance.inverse();
  all.information.topLeftCorner<2, 2>() += first;
  all.vector.head<2>() += first * prior.mean;
  for (Eigen::Index t = 0; t < static_cast<Eigen::Index>(scans.size()); ++t) {
    const AxisScan& scan = scans[static_cast<std::size_t>(t)];
    Eigen::Matrix<double, 2, 4> difference;  // x_{t+1} - F x_t
    difference << -1, -scan.step, 1, 0, 0, -1, 0, 1;
    const Eigen::Matrix2d weight =
        (scan.process_noise * constant_velocity_noise(scan.step)).inverse();
    all.information.block<4, 4>(2 * t, 2 * t) += difference.transpose() * weight * difference;
    if (!std::isfinite(scan.variance)) continue;
    all.information(2 * t + 2, 2 * t + 2) += 1 / scan.variance;
    all.vector(2 * t + 2) += scan.position / scan.variance;
  }
  return all;
}

std::vector<AxisBelief> smooth(const AxisBelief& prior, const std::vector<AxisScan>& scans) {
  std::vector<AxisBelief> result(scans.size() + 1);
  smooth_constant_velocity(prior, scans, result);
  return result;
}

TEST(RtsSmoother, IsTheLeastSquaresSolutionOfAllScans) {
  const std::vector<AxisScan> scans{{1, 0.3, 2.1, 0.5},
                                    {2, 0.1, 4.0, 2.0},
                                    {0.5, 1.5, 1.0, INFINITY},
                                    {1, 0.2, 6.3, 0.1},
                                    {3, 0.4, -2.0, 9.0}};
  const LeastSquares all = stack(wide_prior(), scans);
  const Eigen::MatrixXd covariance = all.information.inverse();
  const Eigen::VectorXd mean = all.information.ldlt().solve(all.vector);
  const auto smoothed = smooth(wide_prior(), scans);
  for (std::size_t t = 0; t < smoothed.size(); ++t) {
    const auto at = static_cast<Eigen::Index>(2 * t);
    EXPECT_LT((smoothed[t].mean - mean.segment<2>(at)).norm(), 1e-10) << t;
    EXPECT_LT((smoothed[t].covariance - covariance.block<2, 2>(at, at)).norm(), 1e-10) << t;
  }
}

TEST(RtsSmoother, WithoutMeasurementsThePriorMovesOn) {
  const auto smoothed = smooth(wide_prior(), {{2, 0.5}, {1, 0.5}});
  EXPECT_LT((smoothed[0].mean - wide_prior().mean).norm(), 1e-12);
  EXPECT_LT((smoothed[0].covariance - wide_prior().covariance).norm(), 1e-12);
  EXPECT_NEAR(smoothed[2].mean(0), 3 - 0.5 * 3, 1e-12);
  EXPECT_NEAR(smoothed[2].mean(1), -0.5, 1e-12);
}

TEST(RtsSmoother, ExactPriorWithoutNoiseDoesNotMove) {
  AxisBelief exact;
  exact.mean << 1, 2;
  exact.covariance.setZero();
  const auto smoothed = smooth(exact, {{1, 0, 100, 1}, {1, 0, -100, 1}});
  EXPECT_DOUBLE_EQ(smoothed[1].mean(0), 3);
  EXPECT_DOUBLE_EQ(smoothed[2].mean(0), 5);
  EXPECT_DOUBLE_EQ(smoothed[0].mean(0), 1);
}

TEST(RtsSmoother, NoiseOfAStepIsThePapers) {
  const Eigen::Matrix2d q = constant_velocity_noise(2);  // P-HPMHT (22) with Delta = 2
  EXPECT_DOUBLE_EQ(q(0, 0), 8.0 / 3);
  EXPECT_DOUBLE_EQ(q(0, 1), 2);
  EXPECT_DOUBLE_EQ(q(1, 0), 2);
  EXPECT_DOUBLE_EQ(q(1, 1), 2);
}

TEST(RtsSmoother, RefusesTooLittleRoom) {
  std::vector<AxisBelief> room(1);
  const std::vector<AxisScan> scans(1);
  EXPECT_THROW(smooth_constant_velocity(wide_prior(), scans, room), std::invalid_argument);
}

}  // namespace
}  // namespace glint

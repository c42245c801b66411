// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <limits>
#include <span>
#include <tuple>

#include <Eigen/Core>

namespace glint {

/// Position and velocity along one axis.
struct AxisBelief {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.mean, s.covariance);
  }
};

/// A time at which the state is wanted, and the position measured there.
struct AxisScan {
  double step = 1;           ///< time since the scan before (since the prior for the first), > 0
  double process_noise = 0;  ///< spectral density of the acceleration on the way here, >= 0
  double position = 0;
  double variance = std::numeric_limits<double>::infinity();  ///< infinite: nothing was measured
};

/// Covariance that white acceleration of unit spectral density gains in `step`. P-HPMHT (22)
Eigen::Matrix2d constant_velocity_noise(double step);

/// Kalman filter over `scans` from a prior and Rauch, Tung and Striebel's recursion back to it, for
/// constant velocity with white acceleration. P-HPMHT (15), (16), from the prior instead of 0 and
/// down to it. Writes scans.size() + 1 beliefs, the prior's time first. Exact: the result is the
/// least-squares solution over all scans and the prior.
void smooth_constant_velocity(const AxisBelief& prior, std::span<const AxisScan> scans,
                              std::span<AxisBelief> smoothed);

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>
#include <numbers>

#include <Eigen/Core>
#include <Eigen/LU>

namespace glint {

/// What is known of a state of N numbers.
template <int N>
struct Gaussian {
  Eigen::Matrix<double, N, 1> mean = Eigen::Matrix<double, N, 1>::Zero();
  Eigen::Matrix<double, N, N> covariance = Eigen::Matrix<double, N, N>::Identity();
};

/// Where a measured position is expected, and how it moves a state of N numbers.
template <int N>
struct PositionPrediction {
  Eigen::Vector2d mean;
  Eigen::Matrix2d covariance, inverse;  ///< of the innovation, S
  Eigen::Matrix<double, N, 2> gain;     ///< K

  /// Squared distance in units of the innovation's spread.
  double distance(const Eigen::Vector2d& position) const {
    const Eigen::Vector2d innovation = position - mean;
    return innovation.dot(inverse * innovation);
  }
  /// Of the density at `position` [1/px^2].
  double log_density(const Eigen::Vector2d& position) const {
    return -distance(position) / 2 - std::log(2 * std::numbers::pi) -
           std::log(covariance.determinant()) / 2;
  }
};

/// `noise`: covariance of the measured position [px^2]. The state's first half is about x, its
/// second about y, each with the position first.
template <int N>
PositionPrediction<N> predict_position(const Gaussian<N>& state, const Eigen::Matrix2d& noise) {
  constexpr int kY = N / 2;
  PositionPrediction<N> p;
  p.mean << state.mean(0), state.mean(kY);
  Eigen::Matrix<double, N, 2> cross;
  cross << state.covariance.col(0), state.covariance.col(kY);
  p.covariance << cross(0, 0), cross(0, 1), cross(kY, 0), cross(kY, 1);
  p.covariance += noise;
  p.inverse = p.covariance.inverse();
  p.gain = cross * p.inverse;
  return p;
}

/// Rounding leaves a covariance a little unsymmetrical, and the error grows from step to step.
template <int N>
void symmetrise(Eigen::Matrix<double, N, N>& m) {
  m = (0.5 * (m + m.transpose())).eval();
}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>
#include <numbers>
#include <tuple>
#include <type_traits>

#include <Eigen/Core>
#include <Eigen/LU>

#include "glint/engine/state/bytes.hpp"

namespace glint {

/// What is known of a state of N numbers.
template <int N>
struct Gaussian {
  Eigen::Matrix<double, N, 1> mean = Eigen::Matrix<double, N, 1>::Zero();
  Eigen::Matrix<double, N, N> covariance = Eigen::Matrix<double, N, N>::Identity();

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.mean, s.covariance);
  }
  void restored() const {
    require_bytes(mean.allFinite() && covariance.allFinite(), "a belief is no such numbers");
  }
};

/// `angle` [rad] in (-pi, pi].
inline double wrapped(double angle) {
  const double rest = std::remainder(angle, 2 * std::numbers::pi);
  return rest > -std::numbers::pi ? rest : std::numbers::pi;
}

/// Where a measurement of M numbers is expected, and how it moves a state of N numbers: computed
/// once, it serves any number of points. Number `Azimuth` of a measurement is an angle, -1: none.
template <int N, int M, int Azimuth = -1>
struct MeasurementPrediction {
  using Vector = Eigen::Matrix<double, M, 1>;
  Vector mean;
  Eigen::Matrix<double, M, M> covariance, inverse;  ///< of the innovation, S
  Eigen::Matrix<double, N, M> gain;                 ///< K
  double half_log_determinant = 0;                  ///< ln sqrt(det S)

  MeasurementPrediction() = default;
  /// Of the expected measurement and the covariance of its noise and the state's spread together;
  /// `cross` is the covariance of the state and the measurement.
  MeasurementPrediction(const Vector& expected, const Eigen::Matrix<double, M, M>& innovation,
                        const Eigen::Matrix<double, N, M>& cross)
      : mean(expected),
        covariance(innovation),
        inverse(innovation.inverse()),
        gain(cross * inverse),
        half_log_determinant(std::log(innovation.determinant()) / 2) {}

  Vector innovation(const Vector& measurement) const {
    Vector difference = measurement - mean;
    if constexpr (Azimuth >= 0) difference(Azimuth) = wrapped(difference(Azimuth));
    return difference;
  }
  /// Squared distance in units of the innovation's spread.
  double distance(const Vector& measurement) const {
    const Vector off = innovation(measurement);
    return off.dot(inverse * off);
  }
  /// Of the density at `measurement` [1 / the measurement's units].
  double log_density(const Vector& measurement) const {
    return -distance(measurement) / 2 - 0.5 * M * std::log(2 * std::numbers::pi) -
           half_log_determinant;
  }
  /// Of what is within `gate`, a squared distance.
  double gate_volume(double gate) const {
    constexpr double kUnitBall = M == 1 ? 2 : (M == 2 ? 1.0 : 4.0 / 3) * std::numbers::pi;
    static_assert(M <= 3);
    return kUnitBall * std::pow(gate, 0.5 * M) * std::exp(half_log_determinant);
  }
};
template <int N, int Axes = 2>
using PositionPrediction = MeasurementPrediction<N, Axes>;

/// Columns of the covariance that belong to the positions; the state begins each axis with it.
template <int Axes, int N>
Eigen::Matrix<double, N, Axes> position_columns(const Gaussian<N>& state) {
  Eigen::Matrix<double, N, Axes> columns;
  for (int axis = 0; axis < Axes; ++axis) {
    columns.col(axis) = state.covariance.col(axis * (N / Axes));
  }
  return columns;
}

/// What the state says of the position alone.
template <int Axes, int N>
Gaussian<Axes> position_of(const Gaussian<N>& state) {
  Gaussian<Axes> position;
  const Eigen::Matrix<double, N, Axes> columns = position_columns<Axes>(state);
  for (int axis = 0; axis < Axes; ++axis) {
    position.mean(axis) = state.mean(axis * (N / Axes));
    position.covariance.row(axis) = columns.row(axis * (N / Axes));
  }
  return position;
}

/// `noise`: covariance of the measured position.
template <int Axes = 2, int N>
PositionPrediction<N, Axes> predict_position(
    const Gaussian<N>& state,
    const std::type_identity_t<Eigen::Matrix<double, Axes, Axes>>& noise) {
  const Gaussian<Axes> position = position_of<Axes>(state);
  return {position.mean, position.covariance + noise, position_columns<Axes>(state)};
}

/// Rounding leaves a covariance a little unsymmetrical, and the error grows from step to step.
template <int N>
void symmetrise(Eigen::Matrix<double, N, N>& m) {
  m = (0.5 * (m + m.transpose())).eval();
}

/// Kalman update by one measurement.
template <int N, int M, int Azimuth>
Gaussian<N> updated(const Gaussian<N>& predicted,
                    const MeasurementPrediction<N, M, Azimuth>& expected,
                    const std::type_identity_t<Eigen::Matrix<double, M, 1>>& measurement) {
  Gaussian<N> result;
  result.mean = predicted.mean + expected.gain * expected.innovation(measurement);
  result.covariance =
      predicted.covariance - expected.gain * expected.covariance * expected.gain.transpose();
  symmetrise(result.covariance);
  return result;
}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <tuple>

#include <Eigen/Core>

#include "glint/engine/filters/gaussian.hpp"

namespace glint {

// What a sensor measures of a position, as a vector of kSize numbers; number kAzimuth of it is an
// angle in (-pi, pi], -1 if there is none. Azimuth turns from x towards y.

/// The position itself, in the coordinates of the state.
template <int Axes>
struct PositionSensor {
  static constexpr int kAxes = Axes, kSize = Axes, kAzimuth = -1;
  Eigen::Matrix<double, Axes, Axes> noise = Eigen::Matrix<double, Axes, Axes>::Identity();
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.noise);
  }
};
/// Range [length] and azimuth [rad]; their noise is above 0.
struct RangeAzimuth {
  static constexpr int kAxes = 2, kSize = 2, kAzimuth = 1;
  Eigen::Matrix2d noise = Eigen::Matrix2d::Identity();
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< of the sensor
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.noise, s.place);
  }
};

template <class Sensor>
using Measurement = Eigen::Matrix<double, Sensor::kSize, 1>;
template <class Sensor>
using Place = Eigen::Matrix<double, Sensor::kAxes, 1>;
/// Derivative of the measurement by the position.
template <class Sensor>
using Jacobian = Eigen::Matrix<double, Sensor::kSize, Sensor::kAxes>;

/// The measurement of a target at `position`, without noise.
template <int Axes>
Eigen::Matrix<double, Axes, 1> expected_measurement(
    const PositionSensor<Axes>&, const Eigen::Matrix<double, Axes, 1>& position) {
  return position;
}
Eigen::Vector2d expected_measurement(const RangeAzimuth& sensor, const Eigen::Vector2d& position);

/// Finite everywhere: at the sensor itself, where there is no direction, as if 1e-9 away from it.
Eigen::Matrix2d jacobian(const RangeAzimuth& sensor, const Eigen::Vector2d& position);

/// The position that a measurement belongs to, with its covariance to first order in the noise:
/// what a track may start from.
template <int Axes>
Gaussian<Axes> inverse_measurement(const PositionSensor<Axes>& sensor,
                                   const Eigen::Matrix<double, Axes, 1>& measurement) {
  return {measurement, sensor.noise};
}
Gaussian<2> inverse_measurement(const RangeAzimuth& sensor, const Eigen::Vector2d& measurement);

}  // namespace glint

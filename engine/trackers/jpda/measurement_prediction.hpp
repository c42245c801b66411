// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cmath>

#include "glint/engine/trackers/jpda/measurement.hpp"
#include "glint/engine/trackers/jpda/principal_axes.hpp"

namespace glint {

/// How a measurement that is not linear is made so: by its derivative at the predicted position
/// (extended Kalman filter), or by its values at points spread as the position is uncertain
/// (unscented), which keeps mean and covariance better where a far target's position is uncertain
/// across the line of sight.
enum class Linearisation { extended, unscented };

/// A measurement about a position: its mean and covariance without noise, and its derivative.
template <class Sensor>
struct LinearMeasurement {
  Measurement<Sensor> mean;
  Eigen::Matrix<double, Sensor::kSize, Sensor::kSize> covariance;
  Jacobian<Sensor> jacobian;
};

template <class Sensor>
LinearMeasurement<Sensor> extended(const Sensor& sensor, const Gaussian<Sensor::kAxes>& position) {
  const Jacobian<Sensor> h = jacobian(sensor, position.mean);
  return {expected_measurement(sensor, position.mean), h * position.covariance * h.transpose(), h};
}

/// Unscented transform of the position alone, since nothing else is measured, along the principal
/// axes of its covariance, so that it may be singular (Julier and Uhlmann 1997, n + kappa = 3).
template <class Sensor>
LinearMeasurement<Sensor> unscented(const Sensor& sensor, const Gaussian<Sensor::kAxes>& position) {
  constexpr int kAxes = Sensor::kAxes;
  constexpr double kWeight =
      1.0 / 6;  // the centre, which differs nothing from itself, has the rest
  const PrincipalAxes<kAxes> principal = principal_axes<kAxes>(position.covariance);
  const Measurement<Sensor> centre = expected_measurement(sensor, position.mean);
  const auto off = [&](const Place<Sensor>& to) {
    Measurement<Sensor> difference = expected_measurement(sensor, position.mean + to) - centre;
    if constexpr (Sensor::kAzimuth >= 0) {
      difference(Sensor::kAzimuth) = wrapped(difference(Sensor::kAzimuth));
    }
    return difference;
  };
  // A shorter chord is all rounding. Number 0 of a measurement is the range.
  const double least = 1e-6 * (centre(0) + std::sqrt(sensor.noise(0, 0)));
  Measurement<Sensor> shift = Measurement<Sensor>::Zero();
  LinearMeasurement<Sensor> result;
  result.covariance.setZero(), result.jacobian.setZero();
  for (int i = 0; i < kAxes; ++i) {
    const double reach = std::max(std::sqrt(3 * std::max(principal.variance(i), 0.0)), least);
    const Place<Sensor> axis = principal.direction.col(i);
    const Measurement<Sensor> ahead = off(reach * axis), behind = off(-reach * axis);
    shift += kWeight * (ahead + behind);
    result.covariance += kWeight * (ahead * ahead.transpose() + behind * behind.transpose());
    result.jacobian += (ahead - behind) / (2 * reach) * axis.transpose();
  }
  result.covariance -= shift * shift.transpose();
  result.mean = centre + shift;
  if constexpr (Sensor::kAzimuth >= 0) {
    result.mean(Sensor::kAzimuth) = wrapped(result.mean(Sensor::kAzimuth));
  }
  return result;
}

/// Of a state whose axes begin with the position.
template <class Sensor, int N>
MeasurementPrediction<N, Sensor::kSize, Sensor::kAzimuth> predict_measurement(
    const Gaussian<N>& state, const Sensor& sensor, Linearisation how = Linearisation::extended) {
  const Gaussian<Sensor::kAxes> position = position_of<Sensor::kAxes>(state);
  const LinearMeasurement<Sensor> linear =
      how == Linearisation::extended ? extended(sensor, position) : unscented(sensor, position);
  return {linear.mean, linear.covariance + sensor.noise,
          position_columns<Sensor::kAxes>(state) * linear.jacobian.transpose()};
}
template <int Axes, int N>
PositionPrediction<N, Axes> predict_measurement(const Gaussian<N>& state,
                                                const PositionSensor<Axes>& sensor,
                                                Linearisation = Linearisation::extended) {
  return predict_position<Axes>(state, sensor.noise);
}

}  // namespace glint

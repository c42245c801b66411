// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>

#include <Eigen/LU>

#include "glint/engine/filters/gaussian.hpp"
#include "glint/engine/trackers/jpda/measurement.hpp"

namespace glint {

/// Nearer to the sensor there is no direction [length]: far less than the noise of a range.
template <class Sensor>
double least_range(const Sensor& sensor) {
  return 1e-9 * std::sqrt(sensor.noise(0, 0));
}

template <class Sensor>
Gaussian<Sensor::kAxes> position_at(const Sensor& sensor, const Place<Sensor>& position) {
  const Jacobian<Sensor> back = jacobian(sensor, position).inverse();
  Gaussian<Sensor::kAxes> result;
  result.mean = position;
  result.covariance = back * sensor.noise * back.transpose();
  symmetrise(result.covariance);
  return result;
}

}  // namespace glint

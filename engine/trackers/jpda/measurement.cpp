// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/jpda/measurement.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "glint/engine/trackers/jpda/principal_axes.hpp"

namespace glint {
namespace {

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

}  // namespace

Eigen::Vector2d expected_measurement(const RangeAzimuth& sensor, const Eigen::Vector2d& position) {
  const Eigen::Vector2d d = position - sensor.place;
  return {d.norm(), wrapped(std::atan2(d.y(), d.x()))};
}

Eigen::Vector3d expected_measurement(const RangeAzimuthElevation& sensor,
                                     const Eigen::Vector3d& position) {
  const Eigen::Vector3d d = position - sensor.place;
  return {d.norm(), wrapped(std::atan2(d.y(), d.x())), std::atan2(d.z(), std::hypot(d.x(), d.y()))};
}

Eigen::Matrix2d jacobian(const RangeAzimuth& sensor, const Eigen::Vector2d& position) {
  Eigen::Vector2d d = position - sensor.place;
  if (d.norm() < least_range(sensor)) d = {least_range(sensor), 0};
  const double range = d.norm(), square = d.squaredNorm();
  return (Eigen::Matrix2d() << d.x() / range, d.y() / range,  //
          -d.y() / square, d.x() / square)
      .finished();
}

Eigen::Matrix3d jacobian(const RangeAzimuthElevation& sensor, const Eigen::Vector3d& position) {
  Eigen::Vector3d d = position - sensor.place;
  if (d.head<2>().norm() < least_range(sensor))
    d.head<2>() = Eigen::Vector2d(least_range(sensor), 0);
  const double ground = d.head<2>().norm(), range = d.norm(), square = d.squaredNorm();
  return (Eigen::Matrix3d() << d.x() / range, d.y() / range, d.z() / range,  //
          -d.y() / (ground * ground), d.x() / (ground * ground), 0,          //
          -d.x() * d.z() / (square * ground), -d.y() * d.z() / (square * ground), ground / square)
      .finished();
}

Gaussian<2> inverse_measurement(const RangeAzimuth& sensor, const Eigen::Vector2d& measurement) {
  const double range = std::max(measurement(0), least_range(sensor)), azimuth = measurement(1);
  return position_at(sensor, sensor.place + range * Eigen::Vector2d(std::cos(azimuth),  //
                                                                    std::sin(azimuth)));
}

Gaussian<3> inverse_measurement(const RangeAzimuthElevation& sensor,
                                const Eigen::Vector3d& measurement) {
  const double range = std::max(measurement(0), least_range(sensor)), azimuth = measurement(1),
               elevation = measurement(2);
  const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth),
                                  std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
  return position_at(sensor, sensor.place + range * direction);
}

template PrincipalAxes<2> principal_axes<2>(const Eigen::Matrix2d& covariance);

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/experiments/radar.hpp"

#include <algorithm>
#include <cmath>

#include "glint/engine/filters/imm_steps.hpp"
#include "glint/engine/trackers/jpda/measured_position.hpp"

namespace glint {

template class ImmOf<3>;

RangeAzimuthElevation sensor_of(const Radar& radar) {
  RangeAzimuthElevation sensor;
  sensor.noise = radar.sd.cwiseAbs2().asDiagonal();
  sensor.place = radar.place;
  return sensor;
}

Eigen::Vector3d expected_measurement(const RangeAzimuthElevation& sensor,
                                     const Eigen::Vector3d& position) {
  return range_azimuth_elevation(position - sensor.place);
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

Gaussian<3> inverse_measurement(const RangeAzimuthElevation& sensor,
                                const Eigen::Vector3d& measurement) {
  const double range = std::max(measurement(0), least_range(sensor)), azimuth = measurement(1),
               elevation = measurement(2);
  const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth),
                                  std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
  return position_at(sensor, sensor.place + range * direction);
}

}  // namespace glint

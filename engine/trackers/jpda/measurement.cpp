// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/jpda/measurement.hpp"

#include <algorithm>
#include <cmath>

#include "glint/engine/trackers/jpda/measured_position.hpp"
#include "glint/engine/trackers/jpda/principal_axes.hpp"

namespace glint {
Eigen::Vector2d expected_measurement(const RangeAzimuth& sensor, const Eigen::Vector2d& position) {
  const Eigen::Vector2d d = position - sensor.place;
  return {d.norm(), wrapped(std::atan2(d.y(), d.x()))};
}

Eigen::Matrix2d jacobian(const RangeAzimuth& sensor, const Eigen::Vector2d& position) {
  Eigen::Vector2d d = position - sensor.place;
  if (d.norm() < least_range(sensor)) d = {least_range(sensor), 0};
  const double range = d.norm(), square = d.squaredNorm();
  return (Eigen::Matrix2d() << d.x() / range, d.y() / range,  //
          -d.y() / square, d.x() / square)
      .finished();
}

Gaussian<2> inverse_measurement(const RangeAzimuth& sensor, const Eigen::Vector2d& measurement) {
  const double range = std::max(measurement(0), least_range(sensor)), azimuth = measurement(1);
  return position_at(sensor, sensor.place + range * Eigen::Vector2d(std::cos(azimuth),  //
                                                                    std::sin(azimuth)));
}

template PrincipalAxes<2> principal_axes<2>(const Eigen::Matrix2d& covariance);

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <tuple>

#include "glint/engine/filters/imm.hpp"
#include "glint/engine/trackers/jpda/measurement.hpp"

namespace glint {

extern template class ImmOf<3>;

/// Range [length], azimuth and elevation above the plane of x and y [rad]; their noise is above 0.
struct RangeAzimuthElevation {
  static constexpr int kAxes = 3, kSize = 3, kAzimuth = 1;
  Eigen::Matrix3d noise = Eigen::Matrix3d::Identity();
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< of the sensor
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.noise, s.place);
  }
};

Eigen::Vector3d expected_measurement(const RangeAzimuthElevation& sensor,
                                     const Eigen::Vector3d& position);
Eigen::Matrix3d jacobian(const RangeAzimuthElevation& sensor, const Eigen::Vector3d& position);
Gaussian<3> inverse_measurement(const RangeAzimuthElevation& sensor,
                                const Eigen::Vector3d& measurement);

}  // namespace glint

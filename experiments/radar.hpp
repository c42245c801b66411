// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <tuple>

#include "glint/engine/filters/imm.hpp"
#include "glint/engine/scenario/radar_scene.hpp"
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

/// The radar of a scene, which measures just that.
RangeAzimuthElevation sensor_of(const Radar& radar);

/// Range [length], azimuth and elevation [rad] of a target at `position`, without noise.
Eigen::Vector3d expected_measurement(const RangeAzimuthElevation& sensor,
                                     const Eigen::Vector3d& position);
/// Derivative of the measurement by the position. Finite everywhere: at the sensor, and straight
/// above it, as if 1e-9 of the range's noise away.
Eigen::Matrix3d jacobian(const RangeAzimuthElevation& sensor, const Eigen::Vector3d& position);
/// The position that a measurement belongs to, with its covariance to first order in the noise.
Gaussian<3> inverse_measurement(const RangeAzimuthElevation& sensor,
                                const Eigen::Vector3d& measurement);

}  // namespace glint

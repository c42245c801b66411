// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <tuple>
#include <vector>

#include "glint/engine/trackers/jpda/measurement.hpp"

namespace glint {

/// A scan as its sensor measured it.
template <class Sensor>
struct SensorScan {
  std::vector<Measurement<Sensor>> points;
  Sensor sensor;
  double clutter_density = 0;  ///< false points per volume of measurements
  double elapsed = 0;          ///< since the scan before [time]

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.points, s.sensor, s.clutter_density, s.elapsed);
  }
};

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "glint/engine/metrics/metrics.hpp"
#include "glint/engine/scenario/truth.hpp"

namespace glint {

/// What one sensor of the Autoferry data set saw at a time. x is east, y is north [m].
struct BoatScan {
  double time = 0;               ///< [s] since the earliest entry of the recording
  Position ship;                 ///< where the sensor is
  std::vector<Position> points;  ///< where it saw something, in the frame of the truth
};

/// A recording of one sensor, with where each boat was at every scan.
struct BoatRecord {
  std::vector<BoatScan> scans;
  std::vector<TruthPoint> truth;  ///< by scan (`frame`), then by boat; x, y [m], vx, vy [m/s]
};

/// Sensors that see positions.
enum class BoatSensor { lidar = 1, radar = 2 };

/// Reads `<scenario>_detections.json` and `<scenario>_groundTruth.json` of the data set
/// (github.com/Autoferry/sensor_fusion_dataset). Truths are interpolated to the times of the scans.
/// Throws UsageError for a file that cannot be read, std::runtime_error that names file and entry
/// for one that is not as the data set has it.
BoatRecord read_autoferry(const std::string& detections, const std::string& truth,
                          BoatSensor sensor);

}  // namespace glint

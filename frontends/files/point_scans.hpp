// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "glint/engine/point_measurement.hpp"

namespace glint {

/// What a sensor found at one time, and where it stood.
struct PointScan {
  std::int64_t frame = 0;
  double time = 0;                    ///< [s]
  double sensor_x = 0, sensor_y = 0;  ///< [px]
  std::vector<PointMeasurement> points;
};

struct PointScans {
  std::vector<PointScan> scans;  ///< frames and times strictly rise
  bool numbered = false;         ///< the file gives frames; else they count its times from 0
};

/// Points out of a file. A .csv table has one point a row, a .jsonl file one object a line, with x
/// and y, or range and azimuth [rad] (and elevation [rad]), which become a position
/// x = sensor_x + range cos(azimuth) cos(elevation), y likewise by the sine; sensor_x and sensor_y,
/// 0 without them, one place a scan; amplitude (NaN, unknown, without it); and frame, time [s], or
/// both. Rows of one frame, or without frames of one time, are one scan; rows without coordinates
/// say that a scan has no points. Scans without a time are `interval` [s] apart.
///
/// Throws UsageError if the file cannot be read; std::runtime_error with file, line and remedy if
/// something is missing, is no number, or goes back in frames or time.
PointScans read_point_scans(const std::string& path, double interval);

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <optional>
#include <string>

#include "glint/engine/scheduler.hpp"

namespace glint {

/// Points that some sensor found, as scans without frames. A .csv table has one point a row, a
/// .jsonl file one object a line, with x and y, or range and azimuth [rad] (and elevation [rad]),
/// which become a position x = range cos(azimuth) cos(elevation), y likewise by the sine; amplitude
/// (NaN, unknown, without it); and frame, time [s], or both. Rows of one frame, or without frames
/// of one time, are one scan; rows without coordinates say that a scan has no points, as do frames
/// that are left out. Scans without a time are 1 / `frame_rate` apart (1 s).
///
/// Throws UsageError if the file cannot be read; std::runtime_error with file, line and remedy if
/// something is missing, is no number, or goes back in frames or time.
std::unique_ptr<Source> open_points(const std::string& path,
                                    std::optional<double> frame_rate = std::nullopt);

}  // namespace glint

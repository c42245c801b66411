// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <optional>
#include <string>

#include "glint/engine/scheduler.hpp"
#include "glint/frontends/usage_error.hpp"

namespace glint {

/// The points of a file (read_point_scans()) as scans without frames, one for every frame from 0
/// on: frames that the file leaves out have no points. Scans without a time are 1 / `frame_rate`
/// apart (1 s). Throws as read_point_scans() does.
std::unique_ptr<Source> open_points(const std::string& path,
                                    std::optional<double> frame_rate = std::nullopt);

/// `frames` with the points of a file, for trackers of both side by side. Rows with a frame go to
/// the frame of that number, and other frames have no points; rows of a time alone go to the one at
/// most half an interval away, and at other frames the sensor did not look. Times are the frames'.
/// `warn` is told of points after the last frame. Throws as read_point_scans() does; next() throws
/// std::runtime_error if points lie between the frames.
std::unique_ptr<Source> with_points(std::unique_ptr<Source> frames, const std::string& path,
                                    const Warn& warn);

}  // namespace glint

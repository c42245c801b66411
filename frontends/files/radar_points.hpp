// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "glint/engine/scenario/radar_scene.hpp"

namespace glint {

/// Writes the points of a radar's scene as a table that read_point_scans() reads: range, azimuth,
/// elevation and where the radar stands, or x and y. A scan without points is a row without
/// coordinates. Returns how many points there are. Throws UsageError if the file cannot be opened,
/// std::runtime_error if it cannot be written.
std::int64_t write_radar_points(const std::string& path, const RadarScene& scene,
                                std::uint64_t seed, std::string_view comments);

}  // namespace glint

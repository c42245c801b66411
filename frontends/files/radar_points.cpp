// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/files/radar_points.hpp"

#include <array>
#include <iterator>
#include <span>
#include <vector>

#include "glint/engine/number_text.hpp"
#include "glint/frontends/files/tables.hpp"

namespace glint {
namespace {

/// To 1 mm and to nine digits of an angle.
void append_cells(std::string& row, std::span<const double> values) {
  for (const double value : values) row += ',', append_rounded(row, value, 9, 3);
}

}  // namespace

std::int64_t write_radar_points(const std::string& path, const RadarScene& scene,
                                std::uint64_t seed, std::string_view comments) {
  const bool polar = scene.radar.measures == RadarMeasurement::range_azimuth_elevation;
  const std::size_t axes = polar ? 3 : 2;
  std::ofstream file = open_output(path);
  file << comments << "frame,time,"
       << (polar ? "range,azimuth,elevation,sensor_x,sensor_y\n" : "x,y\n");
  std::int64_t count = 0;
  for (int scan = 0; scan < scene.scans; ++scan) {
    std::string start = std::to_string(scan);
    append_cells(start, std::array{scan * scene.interval});
    const std::vector<Eigen::Vector3d> points = points_at(scene, seed, scan);
    for (const Eigen::Vector3d& point : points) {
      std::string row = start;
      append_cells(row, std::span(point.data(), axes));
      if (polar) append_cells(row, std::array{scene.radar.place.x(), scene.radar.place.y()});
      file << row << '\n';
    }
    if (points.empty()) file << start << (polar ? ",,,,,\n" : ",,\n");
    count += std::ssize(points);
  }
  flush_output(file, path);
  return count;
}

}  // namespace glint

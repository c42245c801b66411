// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/files/tables.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "glint/engine/number_text.hpp"
#include "glint/frontends/files/csv.hpp"
#include "glint/frontends/usage_error.hpp"

namespace glint {
namespace {

using Columns = std::span<const std::string_view>;

TrackStatus status_of(const CsvRow& row, std::size_t column) {
  for (const auto s : {TrackStatus::tentative, TrackStatus::confirmed, TrackStatus::halted}) {
    if (row.text(column) == name(s)) return s;
  }
  if (row.text(column).empty()) return TrackStatus::confirmed;
  row.refuse(column, "tentative, confirmed or halted");
}

}  // namespace

std::vector<TrackPoint> read_tracks(const std::string& path) {
  static constexpr std::array<std::string_view, 4> kRequired{"frame", "track_id", "x", "y"};
  static constexpr std::array<std::string_view, 16> kOptional{
      "status",   "time",   "vx",        "vy",       "intensity", "existence",
      "var_x",    "cov_xy", "var_y",     "cov_x_vx", "cov_x_vy",  "cov_y_vx",
      "cov_y_vy", "var_vx", "cov_vx_vy", "var_vy"};
  std::vector<TrackPoint> points;
  read_csv(path, kRequired, kOptional, [&](const CsvRow& row) {
    TrackPoint p;
    p.frame = row.integer(0), p.track_id = row.integer(1);
    p.x = row.number(2), p.y = row.number(3);
    p.status = status_of(row, 4);
    p.time = row.number(5);
    p.vx = row.number(6), p.vy = row.number(7);
    p.intensity = row.number(8), p.existence = row.number(9);
    p.var_x = row.number(10), p.cov_xy = row.number(11), p.var_y = row.number(12);
    p.cov_x_vx = row.number(13), p.cov_x_vy = row.number(14);
    p.cov_y_vx = row.number(15), p.cov_y_vy = row.number(16);
    p.var_vx = row.number(17), p.cov_vx_vy = row.number(18), p.var_vy = row.number(19);
    points.push_back(p);
  });
  return points;
}

std::vector<TruthPoint> read_truth(const std::string& path) {
  static constexpr std::array<std::string_view, 4> kRequired{
      "frame or frame0", "track_id or linked_id", "x or cx", "y or cy"};
  static constexpr std::array<std::string_view, 3> kOptional{"vx", "vy", "intensity"};
  std::vector<TruthPoint> points;
  read_csv(path, kRequired, kOptional, [&](const CsvRow& row) {
    points.push_back({row.integer(0), row.integer(1), row.number(2), row.number(3), row.number(4),
                      row.number(5), row.number(6)});
  });
  return points;
}

std::vector<Detection> read_points(const std::string& path) {
  static constexpr std::array<std::string_view, 4> kRequired{"frame", "x", "y", "amplitude"};
  std::vector<Detection> points;
  read_csv(path, kRequired, Columns(), [&](const CsvRow& row) {
    points.push_back({row.integer(0), row.number(1), row.number(2), row.number(3)});
  });
  return points;
}

std::ofstream open_output(const std::string& path) {
  // Appended: a shell that redirects into a file has said itself what becomes of what was there.
  std::ofstream file = path == kStandardOutput
                           ? std::ofstream("/dev/stdout", std::ios::binary | std::ios::app)
                           : std::ofstream(path, std::ios::binary | std::ios::trunc);
  if (!file) throw UsageError(path + ": cannot be written; check the folder and its permissions");
  return file;
}

void flush_output(std::ofstream& file, const std::string& path) {
  if (!file.flush()) throw std::runtime_error(path + ": cannot be written; is the disk full?");
}

std::string comment_lines(std::string_view config, std::string_view title) {
  std::string text = fmt::format("## glint {}, {}\n", GLINT_VERSION, title);
  while (!config.empty()) {
    const std::string_view line = config.substr(0, config.find('\n'));
    text += fmt::format("{}{}\n", line.empty() ? "#" : "# ", line);
    config.remove_prefix(std::min(line.size() + 1, config.size()));
  }
  return text;
}

void write_truth(const std::string& path, std::span<const TruthPoint> truth,
                 std::string_view comments) {
  std::ofstream file = open_output(path);
  file << comments << "frame,track_id,x,y,vx,vy,intensity\n";
  std::string row;
  for (const TruthPoint& p : truth) {
    row = std::to_string(p.frame) + ',' + std::to_string(p.track_id);
    for (const double value : {p.x, p.y, p.vx, p.vy, p.intensity}) {
      row += ',';
      if (!std::isnan(value)) append_number(row, value);
    }
    file << row << '\n';
  }
  flush_output(file, path);
}

}  // namespace glint

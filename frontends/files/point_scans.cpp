// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/files/point_scans.hpp"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

#include "glint/frontends/files/csv.hpp"
#include "glint/frontends/usage_error.hpp"

namespace glint {
namespace {

constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();
constexpr std::array<std::string_view, 10> kColumns{"frame",    "time",    "x",         "y",
                                                    "range",    "azimuth", "elevation", "amplitude",
                                                    "sensor_x", "sensor_y"};
enum Column : std::size_t {
  frame,
  time,
  x,
  y,
  range,
  azimuth,
  elevation,
  amplitude,
  sensor_x,
  sensor_y
};

/// Of one line; what is not there is NaN.
using Row = std::array<double, kColumns.size()>;

/// Gathers rows to scans.
class Scans {
 public:
  Scans(std::string path, double interval) : path_(std::move(path)), interval_(interval) {}

  void add(const Row& row, std::int64_t line) {
    if (std::isnan(row[frame]) && std::isnan(row[time])) {
      refuse(line, "has neither frame nor time; give one of them");
    }
    if (!std::isnan(row[frame]) &&
        (!(row[frame] >= 0 && row[frame] < 0x1p53) || row[frame] != std::trunc(row[frame]))) {
      refuse(line, fmt::format("frame must be a whole number from 0, got {}", row[frame]));
    }
    const bool fresh = scans_.empty() || is_new(row);
    if (fresh) begin(row, line);
    place(row, fresh, line);
    if (const auto point = point_of(row, line)) scans_.back().points.push_back(*point);
    numbered_ = numbered_ || !std::isnan(row[frame]);
  }
  PointScans take() { return {std::move(scans_), numbered_}; }

 private:
  [[noreturn]] void refuse(std::int64_t line, const std::string& why) const {
    throw std::runtime_error(fmt::format("{}:{}: {}", path_, line, why));
  }

  bool is_new(const Row& row) const {
    if (!std::isnan(row[frame])) return static_cast<double>(scans_.back().frame) != row[frame];
    return scans_.back().time != row[time];
  }

  void begin(const Row& row, std::int64_t line) {
    PointScan next;
    next.frame = scans_.empty() ? 0 : scans_.back().frame + 1;
    if (!std::isnan(row[frame])) next.frame = static_cast<std::int64_t>(row[frame]);
    next.time = std::isnan(row[time]) ? interval_ * static_cast<double>(next.frame) : row[time];
    if (!scans_.empty() && next.frame <= scans_.back().frame) {
      refuse(line, fmt::format("frame {} comes after frame {}; sort the rows by frame", next.frame,
                               scans_.back().frame));
    }
    constexpr std::int64_t kFar = 1'000'000;
    if (next.frame - (scans_.empty() ? 0 : scans_.back().frame) > kFar) {
      refuse(line, fmt::format("frame {} is more than {} frames after the one before; give a time "
                               "instead if it is no number of a frame",
                               next.frame, kFar));
    }
    if (!scans_.empty() && !(next.time > scans_.back().time)) {
      refuse(line, fmt::format("time {} comes after time {}; sort the rows by time", next.time,
                               scans_.back().time));
    }
    scans_.push_back(std::move(next));
  }

  /// Of a scan's rows each may name the sensor's place, and all that do must agree.
  void place(const Row& row, bool fresh, std::int64_t line) {
    if (std::isnan(row[sensor_x]) != std::isnan(row[sensor_y])) {
      refuse(line, "holds half a place of the sensor; give sensor_x and sensor_y, or none of them");
    }
    if (std::isnan(row[sensor_x])) return;
    PointScan& scan = scans_.back();
    if (fresh) scan.sensor_x = row[sensor_x], scan.sensor_y = row[sensor_y];
    if (row[sensor_x] != scan.sensor_x || row[sensor_y] != scan.sensor_y) {
      refuse(line, fmt::format("puts the sensor at ({}, {}), the scan's first row at ({}, {}); a "
                               "scan is seen from one place: give these rows a frame of their own",
                               row[sensor_x], row[sensor_y], scan.sensor_x, scan.sensor_y));
    }
  }

  std::optional<PointMeasurement> point_of(const Row& row, std::int64_t line) const {
    const double strength = row[amplitude];
    const bool has_x = !std::isnan(row[x]), has_range = !std::isnan(row[range]);
    if (has_x != !std::isnan(row[y]) || has_range != !std::isnan(row[azimuth])) {
      refuse(line, "holds half a position; give x and y, or range and azimuth, or none of them");
    }
    if (has_x) return PointMeasurement{row[x], row[y], strength};
    if (!has_range) return std::nullopt;
    const double up = std::isnan(row[elevation]) ? 0 : row[elevation];
    const double ground = row[range] * std::cos(up);
    const PointScan& scan = scans_.back();
    return PointMeasurement{scan.sensor_x + ground * std::cos(row[azimuth]),
                            scan.sensor_y + ground * std::sin(row[azimuth]), strength};
  }

  std::string path_;
  double interval_;
  std::vector<PointScan> scans_;
  bool numbered_ = false;
};

void read_table(const std::string& path, Scans& scans) {
  read_csv(path, {}, kColumns, [&](const CsvRow& cells) {
    Row row;
    for (std::size_t i = 0; i < row.size(); ++i) row[i] = cells.number(i);
    scans.add(row, cells.line());
  });
}

void read_lines(const std::string& path, Scans& scans) {
  std::ifstream file(path);
  if (!file) throw UsageError(path + ": cannot be read; check the path");
  std::string text;
  for (std::int64_t line = 1; std::getline(file, text); ++line) {
    if (text.find_first_not_of(" \t\r") == std::string::npos) continue;
    Row row;
    row.fill(kAbsent);
    try {
      const auto object = nlohmann::json::parse(text);
      for (std::size_t i = 0; i < row.size(); ++i) {
        const auto found = object.find(kColumns[i]);
        if (found != object.end() && !found->is_null()) row[i] = found->get<double>();
      }
    } catch (const nlohmann::json::exception& e) {
      throw std::runtime_error(fmt::format("{}:{}: must be one JSON object of numbers a line: {}",
                                           path, line, e.what()));
    }
    scans.add(row, line);
  }
}

}  // namespace

PointScans read_point_scans(const std::string& path, double interval) {
  Scans gathered(path, interval);
  if (path.ends_with(".jsonl")) {
    read_lines(path, gathered);
  } else {
    read_table(path, gathered);
  }
  return gathered.take();
}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/files/autoferry.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "glint/frontends/usage_error.hpp"

namespace glint {
namespace {

using Json = nlohmann::json;

Json read_list(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw UsageError(path + ": cannot be read");
  try {
    Json list = Json::parse(file);
    if (list.is_array() && !list.empty()) return list;
  } catch (const Json::exception& e) {
    throw std::runtime_error(path + ": is no JSON: " + e.what());
  }
  throw std::runtime_error(path + ": must be a list with at least one entry");
}

/// Calls f(entry); what is missing or of a wrong type is reported with the entry's number.
template <class F>
void each_entry(const std::string& path, const Json& list, const F& f) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    try {
      f(list[i]);
    } catch (const Json::exception& e) {
      throw std::runtime_error(fmt::format("{}: entry {}: {}", path, i + 1, e.what()));
    }
  }
}

/// North and east become y and x.
Position position_of(const Json& north_east) {
  return {north_east.at(1).get<double>(), north_east.at(0).get<double>()};
}

/// [[north...], [east...]]; of one point [north, east], of none [].
std::vector<Position> points_of(const Json& measurement, const Position& ship) {
  std::vector<Position> points;
  if (measurement.empty()) return points;
  const auto numbers = [&](std::size_t i) {
    const Json& list = measurement.at(i);
    return list.is_number() ? std::vector{list.get<double>()} : list.get<std::vector<double>>();
  };
  const std::vector<double> north = numbers(0), east = numbers(1);
  for (std::size_t i = 0; i < std::min(north.size(), east.size()); ++i) {
    points.push_back({east[i] + ship.x, north[i] + ship.y});
  }
  return points;
}

/// Where a boat was, by time.
using Track = std::map<double, Position>;

std::map<std::int64_t, Track> read_tracks_of_boats(const std::string& path) {
  std::map<std::int64_t, Track> boats;
  each_entry(path, read_list(path), [&](const Json& entry) {
    for (const Json& boat : entry) {
      boats[boat.at("targetID").get<std::int64_t>()][boat.at("time").get<double>()] =
          position_of(boat.at("position"));
    }
  });
  return boats;
}

/// On the straight line between the fixes about `time`, and beyond the first and the last one.
TruthPoint truth_at_time(const Track& track, double time) {
  auto after = track.upper_bound(time);
  if (after == track.begin()) ++after;
  if (after == track.end()) --after;
  const auto before = std::prev(after);
  const double span = after->first - before->first;
  TruthPoint truth;
  truth.vx = (after->second.x - before->second.x) / span;
  truth.vy = (after->second.y - before->second.y) / span;
  truth.x = before->second.x + truth.vx * (time - before->first);
  truth.y = before->second.y + truth.vy * (time - before->first);
  return truth;
}

}  // namespace

BoatRecord read_autoferry(const std::string& detections, const std::string& truth,
                          BoatSensor sensor) {
  const Json list = read_list(detections);
  BoatRecord record;
  double start = std::numeric_limits<double>::infinity();  // entries are not quite in order
  each_entry(detections, list,
             [&](const Json& entry) { start = std::min(start, entry.at("time").get<double>()); });
  each_entry(detections, list, [&](const Json& entry) {
    const double time = entry.at("time").get<double>();
    if (entry.at("sensorID").get<int>() != static_cast<int>(sensor)) return;
    const Position ship = position_of(entry.at("ownshipPosition"));
    record.scans.push_back({time - start, ship, points_of(entry.at("measurement"), ship)});
  });
  for (const auto& [id, track] : read_tracks_of_boats(truth)) {
    if (track.size() < 2) {
      throw std::runtime_error(fmt::format("{}: boat {} has a single position", truth, id));
    }
    for (std::size_t i = 0; i < record.scans.size(); ++i) {
      TruthPoint point = truth_at_time(track, record.scans[i].time + start);
      point.frame = static_cast<std::int64_t>(i), point.track_id = id;
      record.truth.push_back(point);
    }
  }
  std::ranges::stable_sort(record.truth, {}, &TruthPoint::frame);
  return record;
}

}  // namespace glint

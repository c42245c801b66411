// SPDX-License-Identifier: Apache-2.0
// Trackers of points know no unit of length and no origin: points and settings that are all scaled,
// or points far from the origin, give the same tracks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "glint/engine/metrics/metrics.hpp"
#include "glint/engine/trackers/registry.hpp"
#include "glint/kernels/core/random.hpp"

namespace glint {
namespace {

using Settings = std::vector<std::pair<std::string, ConfigValue>>;

struct Case {
  std::string name, tracker;
  double sd;  ///< of a point along each axis, by the settings [px]
  Settings settings{};
  std::vector<double> lengths{0.1, 1000};  ///< units in which the tracks are the same [px]
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

/// A length in the settings is `length` px; the points lie about `origin`.
struct Unit {
  double length = 1;
  Position origin{0, 0};
};

/// The power of a length in a unit such as "px^2/time^3" or "1/px^2".
int power_of_length(const std::string& unit) {
  if (unit.starts_with("1/px^2")) return -2;
  if (unit.starts_with("px^2")) return 2;
  return unit.starts_with("px") ? 1 : 0;
}

/// The settings with every length in the unit.
ConfigSection scaled(const Case& c, double length) {
  ConfigSection config = find_tracker(c.tracker).config();
  for (ConfigField& field : config.fields()) {
    for (const auto& [key, value] : c.settings) {
      if (field.key == key) assign(field, value);
    }
    auto* const* number = std::get_if<double*>(&field.value);
    if (number != nullptr) assign(field, **number * std::pow(length, power_of_length(field.unit)));
  }
  return config;
}

constexpr int kScans = 60, kSettled = 20;
enum class Course { apart, crossing, line };

/// Of the targets [sd]: `apart` with one that turns, `line` alone on a line without noise across
/// it, so that the box about all points has no area.
std::vector<Position> targets_at(Course course, int scan) {
  const double k = scan;
  if (course == Course::line) return {{1.1 * k, 40}};
  if (course == Course::crossing) return {{1.2 * k, 20 + 0.6 * k}, {80 - 1.1 * k, 22 + 0.5 * k}};
  return {
      {1.2 * k, 20 + 0.2 * k}, {80 - 1.1 * k, 80 + 0.1 * k}, {10 + k, 50 + 6 * std::sin(k / 10)}};
}

double normal(const RandomKey& key, std::uint32_t item, int axis) {
  return static_cast<double>(random_normals(key, item).n[axis]);
}

std::vector<PointMeasurement> points_at(const Case& c, const Unit& unit, Course course, int scan,
                                        std::uint64_t seed) {
  const double sd = c.sd * unit.length;
  const RandomKey noise = random_key(seed, static_cast<std::uint64_t>(scan), Purpose::scenario);
  const RandomKey clutter = random_key(seed, static_cast<std::uint64_t>(scan), Purpose::clutter);
  std::vector<PointMeasurement> points;
  const auto add = [&](double x, double y) {
    points.push_back({unit.origin.x + sd * x, unit.origin.y + sd * y, 10});
  };
  const double across = course == Course::line ? 0 : 1;
  std::uint32_t item = 0;
  for (const Position& p : targets_at(course, scan)) {
    add(p.x + normal(noise, item, 0), p.y + across * normal(noise, item, 1)), ++item;
  }
  for (std::uint32_t i = 0; i < 3 && course != Course::line; ++i) {
    const Words4 r = random_words(clutter, i);
    add(100 * static_cast<double>(uniform(r.w[0])), 100 * static_cast<double>(uniform(r.w[1])));
  }
  return points;
}

TrackLog tracks_of(const Case& c, const Unit& unit, Course course, std::uint64_t seed = 1) {
  const auto tracker = find_tracker(c.tracker).make(scaled(c, unit.length), Device::serial(), seed);
  TrackLog log;
  for (int k = 0; k < kScans; ++k) {
    const std::vector<PointMeasurement> points = points_at(c, unit, course, k, seed);
    Scan scan;
    scan.frame = k, scan.time = k, scan.points = points;
    scan.sensor_x = unit.origin.x - 50 * c.sd * unit.length, scan.sensor_y = unit.origin.y;
    tracker->step(scan, log);
  }
  tracker->finish(log);
  return log;
}

/// Root mean square, over seeds, targets and scans, of the distance to the nearest track [sd].
double rms_error(const Case& c, const Unit& unit) {
  constexpr int kSeeds = 10;
  const double sd = c.sd * unit.length;
  double sum = 0;
  int count = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const TrackLog log = tracks_of(c, unit, Course::apart, static_cast<std::uint64_t>(seed));
    for (int k = kSettled; k < kScans; ++k) {
      for (const Position& target : targets_at(Course::apart, k)) {
        double nearest = 100;
        for (const TrackPoint& p : log.at(k)) {
          const double x = (p.x - unit.origin.x) / sd, y = (p.y - unit.origin.y) / sd;
          nearest = std::min(nearest, std::hypot(x - target.x, y - target.y));
        }
        sum += nearest * nearest, ++count;
      }
    }
  }
  return std::sqrt(sum / count);
}

const Settings kRadar{{"measurement", "range-azimuth"}, {"range_sd", 1.0}, {"azimuth_sd", 0.01}};
const Settings kRadarByChords{{"measurement", "range-azimuth"},
                              {"range_sd", 1.0},
                              {"azimuth_sd", 0.01},
                              {"linearisation", "ukf"}};
const std::vector<Case> kCases{
    {"ImmJpda", "imm-jpda", 1},
    {"ImmMscanJpda", "imm-mscan-jpda", 1},
    {"ImmJpdaOfRanges", "imm-jpda", 1, kRadar},
    {"ImmJpdaOfRangesByChords", "imm-jpda", 1, kRadarByChords},
    {"PmhtImm", "pmht-imm", 3},
    {"PmhtCa", "pmht-ca", 3},
    {"PmhtSinger", "pmht-singer", 3},
    {"PmhtHomothetic", "pmht-homothetic", 3},
    // Its particles are float, and powers of two alone round them alike. They are many, so that two
    // sets of them are alike on the whole.
    {"MmpfPmht", "mmpf-pmht", 3, {{"particles", std::int64_t{1000}}}, {0.125, 1024}},
    {"ImmPdaAi", "imm-pda-ai", 1, {{"measurement_variance", 1.0}}}};

class PointTrackers : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(All, PointTrackers, testing::ValuesIn(kCases),
                         [](const auto& of) { return of.param.name; });

TEST_P(PointTrackers, AreAsGoodFarFromTheOrigin) {
  const double length = 0.02 / GetParam().sd;  // so that the noise is .02
  const double near = rms_error(GetParam(), {length, {0, 0}});
  const double far = rms_error(GetParam(), {length, {500000, 5000000}});
  EXPECT_LT(near, 1.5);
  EXPECT_NEAR(far, near, 0.05 * near);
}

TEST_P(PointTrackers, GiveTheSameTracksInEveryUnitOfLength) {
  const Case& c = GetParam();
  for (const Course course : {Course::apart, Course::crossing, Course::line}) {
    const auto expected = tracks_of(c, {1, {0, 0}}, course).revised();
    if (course != Course::line) {
      EXPECT_GT(expected.size(), 100u);
    }
    for (const double length : c.lengths) {
      const auto tracks = tracks_of(c, {length, {0, 0}}, course).revised();
      ASSERT_EQ(tracks.size(), expected.size()) << length;
      const double most = 1e-6 * c.sd;
      for (std::size_t i = 0; i < tracks.size(); ++i) {
        EXPECT_EQ(tracks[i].frame, expected[i].frame);
        EXPECT_EQ(tracks[i].track_id, expected[i].track_id);
        EXPECT_EQ(tracks[i].status, expected[i].status);
        EXPECT_NEAR(tracks[i].x / length, expected[i].x, most);
        EXPECT_NEAR(tracks[i].y / length, expected[i].y, most);
        EXPECT_NEAR(tracks[i].vx / length, expected[i].vx, most);
      }
    }
  }
}

}  // namespace
}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/scenario/radar_scenes.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "glint/engine/scenario/scene_entry.hpp"

namespace glint {
namespace {

template <class C>
constexpr RadarSceneEntry radar_entry(std::string_view summary) {
  return scene_entry<RadarSceneEntry, C>(summary);
}

constexpr std::array kRadarScenes{
    radar_entry<RadarAircraftScene>(
        "three aircraft that turn past each other, as range, azimuth and elevation of a radar, "
        "and clutter: P-JPDA section 5"),
    radar_entry<MergingBoatsScene>(
        "two boats on a radar that are one echo for a while, as positions"),
};

void describe_radar(FieldList& list, int& scans, double& detection) {
  list("scans", scans, 1, 100000, "", "length of the sequence");
  list("detection", detection, 0, 1, "", "probability that a target gives a point at a scan");
}

/// Straight on, from 15 to 25 s a turn at `rate` [rad/s], straight on.
RadarTarget aircraft(const Kinematics& start, double rate) {
  return {fly(start, {{15, 0}, {10, rate}}), 40};
}

}  // namespace

void describe(FieldList& list, RadarAircraftScene& config) {
  describe_radar(list, config.scans, config.detection);
  list("range_sd", config.range_sd, 0, 1e6, "m", "spread of a measured range");
  list("azimuth_sd", config.azimuth_sd, 0, 3.2, "rad", "spread of a measured azimuth");
  list("elevation_sd", config.elevation_sd, 0, 1.6, "rad", "spread of a measured elevation");
  list("clutter", config.clutter, 0, 100, "1/(m rad^2)",
       "density of false points, to 1500 m, .15 and .05 rad about the aircraft");
  list("sensor_x", config.sensor_x, -1e6, 1e6, "m", "where the radar stands");
  list("sensor_y", config.sensor_y, -1e6, 1e6, "m", "where the radar stands");
}

RadarScene make_scene(const RadarAircraftScene& config) {
  RadarScene scene;
  scene.name = RadarAircraftScene::kName;
  scene.scans = config.scans;
  scene.radar.measures = RadarMeasurement::range_azimuth_elevation;
  scene.radar.place << config.sensor_x, config.sensor_y, 0;
  scene.radar.sd << config.range_sd, config.azimuth_sd, config.elevation_sd;
  scene.radar.detection = config.detection;
  scene.radar.clutter = config.clutter;
  scene.radar.margin << 1500, 0.15, 0.05;  // far larger than any gate
  scene.targets = {aircraft({10500, 1740, -140, 299.9}, -0.32),
                   aircraft({9800, 1960, 0, 299}, 0.32), aircraft({9200, 1740, 0, 299}, 0)};
  return scene;
}

void describe(FieldList& list, MergingBoatsScene& config) {
  describe_radar(list, config.scans, config.detection);
  list("sd", config.sd, 0, 1e6, "m", "spread of a point along x and y");
  list("clutter", config.clutter, 0, 1, "1/m^2",
       "density of false points, to 60 m about the boats");
  list("speed", config.speed, 0, 1000, "m/s", "of both boats along x");
  list("apart", config.apart, 0, 1e6, "m", "how far the second boat is from the first along y");
  list("merge", config.merge, 0, 1e6, "s", "from then on both are one echo, where the second is");
  list("part", config.part, 0, 1e6, "s", "from then on they are two echoes again, and part");
  list("parting", config.parting, 0, 1000, "m/s", "how fast the second boat leaves the first");
}

RadarScene make_scene(const MergingBoatsScene& config) {
  RadarScene scene;
  scene.name = MergingBoatsScene::kName;
  scene.scans = config.scans;
  scene.interval = 2.5;
  scene.radar.sd << config.sd, config.sd, 0;
  scene.radar.detection = config.detection;
  scene.radar.clutter = config.clutter;
  scene.radar.margin << 60, 60, 0;
  const auto second = [c = config](double time) {
    const double y = c.apart + c.parting * std::max(time - c.part, 0.0);
    return Kinematics{c.speed * time, y, c.speed, time > c.part ? c.parting : 0};
  };
  scene.targets = {{fly({0, 0, config.speed, 0}), 0, config.merge, config.part}, {second}};
  return scene;
}

std::span<const RadarSceneEntry> all_radar_scenes() { return kRadarScenes; }

const RadarSceneEntry* find_radar_scene(std::string_view name) {
  const auto found = std::ranges::find(kRadarScenes, name, &RadarSceneEntry::name);
  return found == kRadarScenes.end() ? nullptr : &*found;
}

}  // namespace glint

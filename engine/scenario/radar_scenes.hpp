// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <string_view>

#include "glint/engine/config.hpp"
#include "glint/engine/scenario/radar_scene.hpp"

namespace glint {

/// P-JPDA section 5: three aircraft 40 m above the plane of the radar and 9 to 15 km away. Between
/// 15 and 25 s two of them turn by half a circle, each its own way, past the third.
struct RadarAircraftScene {
  static constexpr std::string_view kName = "radar-aircraft";
  int scans = 36;                                                  ///< 1 s apart
  double range_sd = 20, azimuth_sd = 0.007, elevation_sd = 0.002;  ///< [m], [rad]
  double detection = 0.997;
  double clutter = 0.1;               ///< [1/(m rad^2)]
  double sensor_x = 0, sensor_y = 0;  ///< [m]
};
void describe(FieldList& list, RadarAircraftScene& config);
RadarScene make_scene(const RadarAircraftScene& config);

/// Two boats side by side, seen by a radar that turns once in 2.5 s. For a while both are one echo,
/// where the second is; then they part: who has followed the echo with both has to choose.
struct MergingBoatsScene {
  static constexpr std::string_view kName = "merging-boats";
  int scans = 54;
  double sd = 5;  ///< of a point along x and y [m]
  double detection = 0.9;
  double clutter = 0;            ///< [1/m^2]
  double speed = 3, apart = 20;  ///< [m/s], [m]
  double merge = 30, part = 75;  ///< [s]
  double parting = 0.3;          ///< [m/s]
};
void describe(FieldList& list, MergingBoatsScene& config);
RadarScene make_scene(const MergingBoatsScene& config);

/// How a radar's scene is found by name, configured and made.
struct RadarSceneEntry {
  std::string_view name, summary;
  ConfigSection (*config)();  ///< its defaults, section "scenes.<name>"
  /// `config` is a section that `config()` made.
  RadarScene (*make)(const ConfigSection& config);
};

/// The one list of scenes that are points.
std::span<const RadarSceneEntry> all_radar_scenes();
/// Null if there is none of that name.
const RadarSceneEntry* find_radar_scene(std::string_view name);

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "glint/engine/scenario/path.hpp"
#include "glint/engine/scenario/truth.hpp"

namespace glint {

enum class RadarMeasurement {
  position,                 ///< x, y [m]; the third number is 0
  range_azimuth_elevation,  ///< [m], [rad] from x towards y, [rad] above the plane of x and y
};

/// A radar as a scene has it. What it measures is in three numbers, as RadarMeasurement says.
struct Radar {
  RadarMeasurement measures = RadarMeasurement::position;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< where it stands [m]
  Eigen::Vector3d sd = Eigen::Vector3d::Zero();     ///< of what is measured, Gaussian
  double detection = 1;                             ///< probability that a target gives a point
  /// Density of false points [1/m^2] or [1/(m rad^2)]: Poisson, uniform over the box about the
  /// targets and `margin` beyond it on every side.
  double clutter = 0;
  Eigen::Vector3d margin = Eigen::Vector3d::Zero();
};

/// A target that keeps its height.
struct RadarTarget {
  Path path;                                 ///< over the plane, by time from scan 0
  double height = 0;                         ///< [m]
  double merged_from = 0, merged_until = 0;  ///< [s] its echo is another's: it gives no point
};

/// What a radar sees that looks once every `interval`: everything that follows is a function of the
/// scene, a seed and the scan, counted from 0.
struct RadarScene {
  std::string name;
  int scans = 0;
  double interval = 1;  ///< [s]
  Radar radar;
  std::vector<RadarTarget> targets;
};

/// Range, azimuth and elevation of what is at `offset` from the sensor.
Eigen::Vector3d range_azimuth_elevation(const Eigen::Vector3d& offset);

/// Where a target is [m].
Eigen::Vector3d place_at(const RadarScene& scene, std::size_t target, int scan);
/// All targets, by id, in the plane [m]; ids count from 0 in the order of the targets.
std::vector<TruthPoint> truth_at(const RadarScene& scene, int scan);
/// The same for all scans, by scan, then by id.
std::vector<TruthPoint> truth_of(const RadarScene& scene);
/// What the radar measures at a scan, targets and false points, by rising x or range.
std::vector<Eigen::Vector3d> points_at(const RadarScene& scene, std::uint64_t seed, int scan);

}  // namespace glint

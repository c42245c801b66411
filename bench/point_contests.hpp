// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "glint/engine/point_measurement.hpp"
#include "glint/engine/scenario/path.hpp"

namespace glint::bench {

/// Scans of points with targets that are known at the first, one a frame.
struct PointScans {
  std::vector<Kinematics> starts;  ///< at the first scan
  std::vector<std::vector<PointMeasurement>> points;
  double clutter_density = 0;  ///< [1/px^2]
};
/// P-PMHT section 4: forty targets over 1024x256 pixels, which cross, false points in
/// .02 % of the pixels; the first `targets` and `scans` of them, 61 scans at most.
PointScans forty_targets(std::size_t targets = 40, std::size_t scans = 30);

/// [x vx y vy] of every target after the last scan, in the order of the starts.
using PointStates = std::vector<Eigen::Vector4d>;

/// A tracker of points beside what one would write without ado (bench/baselines/): the same
/// targets, models, gates and windows.
struct PointContest {
  using Follow = std::function<PointStates(const PointScans&, std::uint64_t seed)>;
  std::string tracker;   ///< its name in the registry
  std::string baseline;  ///< what is plain about it
  Follow ours, plain;
  // The two agree if the medians over `runs` seeds of all positions after the last scan differ by
  // no more than `tolerance` [px], root mean square: 1 and rounding for those that draw nothing.
  int runs = 1;
  double tolerance = 1e-6;
};
/// One for every tracker of points.
std::vector<PointContest> point_contests();

}  // namespace glint::bench

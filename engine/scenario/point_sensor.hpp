// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "glint/engine/point_measurement.hpp"
#include "glint/engine/scenario/scenario.hpp"

namespace glint {

/// A detector that sees a scene as points: every target once, and false points.
struct PointSensor {
  double variance = 0;    ///< Gaussian, of a target's point along each axis [px^2]
  bool rounds = true;     ///< to whole pixels
  int clutter = 0;        ///< false points a frame, uniform over the pixels
  int clutter_from = 2;   ///< first frame with false points
  double amplitude = 10;  ///< of every point

  /// False points a frame where `percent` of the scene's pixels are noisy, and their density.
  static int clutter_of(const Scene& scene, double percent);
  double clutter_density(const Scene& scene) const;  ///< [1/px^2]
};

/// The point of a target.
PointMeasurement point_of(const TruthPoint& target, const PointSensor& sensor, std::uint64_t seed);

/// All points of `frame`, row by row. A function of its arguments.
std::vector<PointMeasurement> points_at(const Scene& scene, const PointSensor& sensor,
                                        std::uint64_t seed, int frame);

}  // namespace glint

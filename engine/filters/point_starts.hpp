// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <vector>

#include <Eigen/Core>

#include "glint/engine/filters/scan_points.hpp"

namespace glint {

/// A point that no track has.
struct FreePoint {
  Eigen::Vector2d position;  ///< [px]
  double amplitude = 0;      ///< [sigma]
};

/// Two points, of one scan and of the next, that may be one new target.
struct PointStart {
  FreePoint before, now;
};

/// Starts tracks from pairs of points.
class PointStarts {
 public:
  /// Of the points that were free at the last call and those that now are, if bright enough or of
  /// unknown amplitude.
  std::span<const PointStart> next(const ScanPoints& points, double least_amplitude, double reach);
  /// Pairs at most `reach` [px] apart, each point in one pair: the brightest first, of equals the
  /// nearest, then in the order of the points. Valid until the next call.
  std::span<const PointStart> find(std::span<const FreePoint> before,
                                   std::span<const FreePoint> now, double reach);

 private:
  struct Candidate {
    double amplitude, distance;
    std::size_t before, now;
  };
  std::vector<FreePoint> free_, free_before_;
  std::vector<Candidate> candidates_;
  std::vector<bool> taken_before_, taken_now_;
  std::vector<PointStart> starts_;
};

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <tuple>
#include <vector>

#include <Eigen/Geometry>

#include "glint/engine/scan.hpp"

namespace glint {

/// Its place is known.
bool placed(const PointMeasurement& point);

/// Where points may lie: the frame, or without one the box about all points so far.
class PointArea {
 public:
  void see(const Scan& scan);
  /// [px^2], with `margin` [px] about a box; at least `least`: all points may lie in one place.
  double size(double least, double margin = 0) const;

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.box_.min(), s.box_.max(), s.frame_);
  }

 private:
  Eigen::AlignedBox2d box_;
  double frame_ = 0;  // [px^2]
};

/// The points of a scan as trackers take them: those whose place is known, and how far each is some
/// track's.
struct ScanPoints {
  static constexpr double kClaimed = 0.5;  ///< a point of which more is taken is no other track's

  std::vector<Eigen::Vector2d> positions;  ///< [px]
  std::vector<double> amplitudes;          ///< [sigma]; NaN if not known
  std::vector<double> claimed;
  PointArea area;

  void take(const Scan& scan);
  /// One by one, for trackers that choose or find their points themselves.
  void clear() { positions.clear(), amplitudes.clear(), claimed.clear(); }
  void add(const Eigen::Vector2d& position, double amplitude) {
    positions.push_back(position), amplitudes.push_back(amplitude), claimed.push_back(0);
  }
  bool free(std::size_t point) const { return claimed[point] < kClaimed; }
  /// Of the points beyond one a target, at least one point [1/px^2], over the area's size().
  double false_density(std::size_t targets, double least_area, double margin = 0) const;
};

}  // namespace glint

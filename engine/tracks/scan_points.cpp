// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/tracks/scan_points.hpp"

#include <algorithm>
#include <cmath>

namespace glint {

bool placed(const PointMeasurement& p) { return std::isfinite(p.x) && std::isfinite(p.y); }

void PointArea::see(const Scan& scan) {
  const Frame& frame = scan.raw ? scan.raw : scan.whitened;
  frame_ = static_cast<double>(frame.width()) * frame.height();
  if (frame_ > 0) return;
  for (const PointMeasurement& p : scan.points) {
    if (placed(p)) box_.extend(Eigen::Vector2d(p.x, p.y));
  }
}

double PointArea::size(double least, double margin) const {
  if (frame_ > 0) return frame_;
  if (box_.isEmpty()) return least;
  const Eigen::Vector2d sides = box_.sizes() + Eigen::Vector2d::Constant(2 * margin);
  return std::max(sides.prod(), least);
}

void ScanPoints::take(const Scan& scan) {
  clear();
  for (const PointMeasurement& p : scan.points) {
    if (placed(p)) add({p.x, p.y}, p.amplitude);
  }
  area.see(scan);
}

double ScanPoints::false_density(std::size_t targets, double least_area, double margin) const {
  const double beyond = static_cast<double>(positions.size()) - static_cast<double>(targets);
  return std::max(beyond, 1.0) / area.size(least_area, margin);
}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/tracks/scan_points.hpp"

#include <algorithm>
#include <cmath>

namespace glint {
namespace {

bool placed(const Point& p) { return std::isfinite(p.x) && std::isfinite(p.y); }

}  // namespace

void PointArea::see(const Scan& scan) {
  const Frame& frame = scan.raw ? scan.raw : scan.whitened;
  frame_ = static_cast<double>(frame.width()) * frame.height();
  if (frame_ > 0) return;
  for (const Point& p : scan.points) {
    if (placed(p)) box_.extend(Eigen::Vector2d(p.x, p.y));
  }
}

double PointArea::size(double margin) const {
  if (frame_ > 0) return frame_;
  if (box_.isEmpty()) return 1;
  const Eigen::Vector2d sides = box_.sizes() + Eigen::Vector2d::Constant(2 * margin);
  return std::max(sides.prod(), 1.0);
}

void ScanPoints::take(const Scan& scan) {
  positions.clear(), amplitudes.clear();
  for (const Point& p : scan.points) {
    if (!placed(p)) continue;
    positions.emplace_back(p.x, p.y);
    amplitudes.push_back(static_cast<double>(p.amplitude));
  }
  claimed.assign(positions.size(), 0);
  area.see(scan);
}

double ScanPoints::false_density(std::size_t targets, double margin) const {
  const double beyond = static_cast<double>(positions.size()) - static_cast<double>(targets);
  return std::max(beyond, 1.0) / area.size(margin);
}

}  // namespace glint

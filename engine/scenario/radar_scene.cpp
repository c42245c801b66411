// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/scenario/radar_scene.hpp"

#include <algorithm>
#include <cmath>

#include "glint/engine/filters/gaussian.hpp"
#include "glint/kernels/core/random.hpp"

namespace glint {
namespace {

Eigen::Vector3d measured(const Radar& radar, const Eigen::Vector3d& place) {
  if (radar.measures == RadarMeasurement::position) return {place.x(), place.y(), 0};
  return range_azimuth_elevation(place - radar.place);
}

/// Whether a target is seen is another draw than its noise. Two numbers, for the points that the
/// experiments' bands were found with.
std::uint32_t detection_draw(RadarMeasurement measures) {
  return measures == RadarMeasurement::position ? 1 : 8;
}

bool gives_a_point(const RadarScene& scene, std::size_t target, RandomKey key, double time) {
  const RadarTarget& t = scene.targets[target];
  if (time >= t.merged_from && time < t.merged_until) return false;
  const auto draw =
      random_words(key, static_cast<std::uint32_t>(target), detection_draw(scene.radar.measures));
  return static_cast<double>(uniform(draw.w[0])) <= scene.radar.detection;
}

Eigen::Vector3d noise_of(const Radar& radar, std::size_t target, RandomKey key) {
  const Normals4 n = random_normals(key, static_cast<std::uint32_t>(target));
  return radar.sd.cwiseProduct(Eigen::Vector3f(n.n[0], n.n[1], n.n[2]).cast<double>());
}

/// `targets`: what would be measured of them without noise.
void add_clutter(const Radar& radar, const std::vector<Eigen::Vector3d>& targets, RandomKey key,
                 std::vector<Eigen::Vector3d>& points) {
  const bool polar = radar.measures != RadarMeasurement::position;
  Eigen::Vector3d low = targets.front(), high = low;
  for (Eigen::Vector3d t : targets) {
    // The box lies around the targets, not around the radar, wherever azimuths jump.
    if (polar) t.y() = targets.front().y() + wrapped(t.y() - targets.front().y());
    low = low.cwiseMin(t), high = high.cwiseMax(t);
  }
  low -= radar.margin, high += radar.margin;
  if (polar) low.x() = std::max(0.0, low.x());
  const int axes = radar.measures == RadarMeasurement::position ? 2 : 3;
  const double expected = radar.clutter * (high - low).head(axes).prod();
  double arrived = 0;  // of a Poisson process
  for (std::uint32_t i = 0;; ++i) {
    const Words4 w = random_words(key, i);
    arrived -= std::log(static_cast<double>(uniform(w.w[3])));
    if (arrived > expected) return;
    const Eigen::Vector3f share(uniform(w.w[0]), uniform(w.w[1]), uniform(w.w[2]));
    Eigen::Vector3d& point =
        points.emplace_back(low + share.cast<double>().cwiseProduct(high - low));
    if (polar) point.y() = wrapped(point.y());
  }
}

}  // namespace

Eigen::Vector3d range_azimuth_elevation(const Eigen::Vector3d& offset) {
  return {offset.norm(), std::atan2(offset.y(), offset.x()),
          std::atan2(offset.z(), std::hypot(offset.x(), offset.y()))};
}

Eigen::Vector3d place_at(const RadarScene& scene, std::size_t target, int scan) {
  const RadarTarget& t = scene.targets[target];
  const Kinematics k = t.path(scan * scene.interval);
  return {k.x, k.y, t.height};
}

std::vector<TruthPoint> truth_at(const RadarScene& scene, int scan) {
  std::vector<TruthPoint> truth;
  for (std::size_t id = 0; id < scene.targets.size(); ++id) {
    const Kinematics k = scene.targets[id].path(scan * scene.interval);
    TruthPoint point{.frame = scan, .track_id = static_cast<std::int64_t>(id), .x = k.x, .y = k.y};
    point.vx = k.vx, point.vy = k.vy;
    truth.push_back(point);
  }
  return truth;
}

std::vector<TruthPoint> truth_of(const RadarScene& scene) {
  std::vector<TruthPoint> all;
  for (int scan = 0; scan < scene.scans; ++scan) {
    const std::vector<TruthPoint> now = truth_at(scene, scan);
    all.insert(all.end(), now.begin(), now.end());
  }
  return all;
}

std::vector<Eigen::Vector3d> points_at(const RadarScene& scene, std::uint64_t seed, int scan) {
  const auto frame = static_cast<std::uint64_t>(scan);
  const RandomKey key = random_key(seed, frame, Purpose::scenario);
  std::vector<Eigen::Vector3d> targets, points;
  for (std::size_t t = 0; t < scene.targets.size(); ++t) {
    targets.push_back(measured(scene.radar, place_at(scene, t, scan)));
    if (!gives_a_point(scene, t, key, scan * scene.interval)) continue;
    points.emplace_back(targets.back() + noise_of(scene.radar, t, key));
  }
  add_clutter(scene.radar, targets, random_key(seed, frame, Purpose::clutter), points);
  std::ranges::stable_sort(points, {}, [](const Eigen::Vector3d& p) { return p.x(); });
  return points;
}

}  // namespace glint

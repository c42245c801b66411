// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/scenario/point_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "glint/kernels/core/random.hpp"

namespace glint {
namespace {

/// `size` scaled by a random word.
double pixel(std::uint32_t word, int size) {
  return static_cast<double>(
      (static_cast<std::uint64_t>(word) * static_cast<std::uint64_t>(size)) >> 32);
}

}  // namespace

int PointSensor::clutter_of(const Scene& scene, double percent) {
  return static_cast<int>(std::lround(percent / 100 * scene.width * scene.height));
}

double PointSensor::clutter_density(const Scene& scene) const {
  return static_cast<double>(clutter) / scene.width / scene.height;
}

PointMeasurement point_of(const TruthPoint& target, const PointSensor& sensor, std::uint64_t seed) {
  const RandomKey key =
      random_key(seed, static_cast<std::uint64_t>(target.frame), Purpose::scenario);
  const Normals4 n = random_normals(key, static_cast<std::uint32_t>(target.track_id));
  const double sigma = std::sqrt(sensor.variance);
  double x = target.x + sigma * static_cast<double>(n.n[0]);
  double y = target.y + sigma * static_cast<double>(n.n[1]);
  if (sensor.rounds) x = std::round(x), y = std::round(y);
  return {x, y, sensor.amplitude};
}

std::vector<PointMeasurement> points_at(const Scene& scene, const PointSensor& sensor,
                                        std::uint64_t seed, int frame) {
  std::vector<PointMeasurement> points;
  for (const TruthPoint& target : truth_at(scene, frame)) {
    points.push_back(point_of(target, sensor, seed));
  }
  const RandomKey clutter = random_key(seed, static_cast<std::uint64_t>(frame), Purpose::clutter);
  const int count = frame >= sensor.clutter_from ? sensor.clutter : 0;
  for (int i = 0; i < count; ++i) {
    const Words4 r = random_words(clutter, static_cast<std::uint32_t>(i));
    points.push_back({pixel(r.w[0], scene.width), pixel(r.w[1], scene.height), sensor.amplitude});
  }
  std::stable_sort(points.begin(), points.end(),
                   [](const PointMeasurement& a, const PointMeasurement& b) {
                     return std::tie(a.y, a.x) < std::tie(b.y, b.x);
                   });
  return points;
}

}  // namespace glint

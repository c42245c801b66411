// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/detector.hpp"

#include <cmath>

namespace glint {
namespace {

/// 2 half_width + 1 pixels a side around the pixel that holds the target.
Box box_around(const Peak& target, int half_width) {
  const int x = static_cast<int>(std::floor(target.x + 0.5));
  const int y = static_cast<int>(std::floor(target.y + 0.5));
  return {x - half_width, y - half_width, x + half_width + 1, y + half_width + 1};
}

}  // namespace

void describe_found_target(FieldList& f, DetectorConfig& c, FollowedTargetsConfig& followed) {
  f.automatic("cluster_radius", c.cluster_radius, 0, 20, "px",
              "half side of a target's particle box; auto is half the window of the point spread");
  f("target_particles", followed.target_particles, 10, 1000000, "",
    "particles that follow a target");
  f.automatic("mask_half_width", c.mask_half_width, 0, 1000, "px",
              "the detector is blind this far around tracked targets; auto is half the window");
}

Detector::Detector(const DetectorConfig& config, const Device& device, std::uint64_t seed,
                   WeightSum weight_sum)
    : config_(config), filter_(config, device, seed, weight_sum) {}

void Detector::update(const Frame& z, const StepTime& at,
                      std::span<const FollowedTarget> followed) {
  width_ = z.width(), height_ = z.height();
  const int half_width = filter_.appearance().mask_half_width(config_.mask_half_width);
  boxes_.clear();
  for (const FollowedTarget& t : followed) boxes_.push_back(box_around(t.estimate, half_width));
  mask_.set(boxes_, width_, height_);
  filter_.predict(z, at.frame, at.step, mask_);
  filter_.update(z, at.frame);
}

std::span<const Cluster> Detector::find(double threshold) {
  const TargetAppearance& appearance = filter_.appearance();
  const Particles& particles = filter_.particles();
  const double radius = appearance.cluster_radius(config_.cluster_radius);
  clusters_.clear();
  for (const Peak& peak : peaks_.find(particles, filter_.runs(), width_, height_,
                                      appearance.spread().half_width, {threshold, radius})) {
    clusters_.push_back({peak, particles, peaks_.members(peak)});
  }
  return clusters_;
}

}  // namespace glint

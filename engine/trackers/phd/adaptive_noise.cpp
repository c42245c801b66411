// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/adaptive_noise.hpp"

#include <algorithm>
#include <cmath>

namespace glint {

const AdaptiveNoise::Target* AdaptiveNoise::find(std::uint32_t label) const {
  const auto at = std::ranges::lower_bound(targets_, label, {}, &Target::label);
  return at != targets_.end() && at->label == label ? &*at : nullptr;
}

void AdaptiveNoise::update(std::span<const Peak> clusters, std::span<const std::uint32_t> members,
                           const Particles& particles) {
  if (range_ <= 1) return;
  next_.clear();
  for (const Peak& cluster : clusters) {
    const std::uint32_t label =
        cluster.last > cluster.first ? particles.label[members[cluster.first]] : 0;
    if (label == 0) continue;
    const double now = cluster.var_x * cluster.var_y - cluster.cov_xy * cluster.cov_xy;
    const Target* before = find(label);
    double noise = before ? before->noise : 1;
    if (before && now > 0 && before->determinant > 0) {  // P-PHD (21)
      noise = now >= before->determinant
                  ? 1 + (noise - 1) * std::exp(1 - now / before->determinant)
                  : range_ + (noise - range_) * std::exp(1 - before->determinant / now);
    }
    next_.push_back({label, noise, now});
  }
  std::ranges::sort(next_, {}, &Target::label);
  std::swap(targets_, next_);
}

std::span<const float> AdaptiveNoise::scales(std::span<const std::uint32_t> labels) {
  if (range_ <= 1) return {};
  scales_.assign(labels.size(), 1.0f);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (const Target* target = find(labels[i])) {
      scales_[i] = static_cast<float>(std::sqrt(target->noise));
    }
  }
  return scales_;
}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "glint/engine/trackers/phd/followed_targets.hpp"
#include "glint/engine/trackers/phd/peaks.hpp"
#include "glint/engine/trackers/phd/phd_filter.hpp"
#include "glint/engine/trackers/phd/pixel_mask.hpp"

namespace glint {

/// Settings of a detector.
struct DetectorConfig : PhdFilterConfig {
  DetectorConfig() {
    snr_low = 8, snr_high = 18;
    intensity_walk = 0.5;
    motion = "cv+ct";
  }
  double cluster_radius = 0;   ///< half side of a target's box [px]; 0 = auto, half the window
  double mask_half_width = 5;  ///< half side of a mask's box [px]; 0 = auto, half the window
};
/// Lists cluster_radius, target_particles and mask_half_width, which `mm-phd` and `mm-pf` share.
void describe_found_target(FieldList& f, DetectorConfig& c, FollowedTargetsConfig& followed);

/// Finds the targets that have no track yet: a PHD filter that is masked around those that have
/// one, and the peaks of its posterior mass. Each scan takes update(), find(), then resample().
class Detector {
 public:
  Detector(const DetectorConfig& config, const Device& device, std::uint64_t seed,
           WeightSum weight_sum = WeightSum::expected_targets);
  void set_appearance(const TargetAppearance& appearance) { filter_.set_appearance(appearance); }

  /// Predicts and updates the PHD filter by the frame `z`. No particle keeps weight and none is
  /// born in the boxes around the targets that are followed. P-PHD (9)-(19), (36)
  void update(const Frame& z, const StepTime& at, std::span<const FollowedTarget> followed);
  /// Expected number of targets.
  double expected() const { return filter_.expected(); }
  /// Clusters whose mass is at least `threshold`, by falling mass of their box; valid until the
  /// next call of a function that is not const.
  std::span<const Cluster> find(double threshold);
  /// Sets the weights of a found cluster's particles to 0.
  void remove(const Cluster& cluster) { filter_.remove(cluster.members); }
  void resample(std::int64_t frame) { filter_.resample(frame); }

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.filter_);
  }

 private:
  DetectorConfig config_;
  PhdFilter filter_;
  PeakFinder peaks_;
  std::vector<Box> boxes_;
  PixelMask mask_;
  std::vector<Cluster> clusters_;
  int width_ = 0, height_ = 0;  // of the last frame [px]
};

}  // namespace glint

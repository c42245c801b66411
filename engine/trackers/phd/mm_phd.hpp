// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <tuple>
#include <vector>

#include "glint/engine/trackers/phd/backward_pass.hpp"
#include "glint/engine/trackers/phd/followed_targets.hpp"
#include "glint/engine/trackers/phd/phd_filter.hpp"
#include "glint/engine/tracks/tracker.hpp"

namespace glint {

/// Settings of `mm-phd`.
struct MmPhdConfig : PhdFilterConfig {
  MmPhdConfig() {
    snr_low = 8, snr_high = 18;
    intensity_walk = 0.5;
    motion = "cv+ct";
  }
  double existence = 0.5;     ///< least mass of a peak, least existence of a hit
  double cluster_radius = 0;  ///< [px]; 0 = auto, half the window
  int target_particles = 1500;
  double mask_half_width = 5;  ///< half side [px]; 0 = auto, half the window
  int confirm_hits = 5, halt_misses = 3;
  double separation = 6;  ///< [px]
  int backward_frames = 12;
  FollowedTargetsConfig known_targets() const;
};
void describe(FieldList& f, MmPhdConfig& c);

/// MM-PHD track-before-detect, P-PHD section 4: a PHD detector over all motion models finds new
/// targets, each one then has a particle filter of its own, and when a track is confirmed a
/// backward pass finds where it came from.
class MmPhd : public TrackerOf<MmPhd> {
 public:
  /// Throws ConfigError for settings that do not fit together.
  MmPhd(const MmPhdConfig& config, const Device& device, std::uint64_t seed);
  Feed feed() const override { return Feed::frames; }
  void step(const Scan& scan, TrackLog& log) override;
  std::vector<std::string> notes() const override { return {appearance_.note()}; }

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.appearance_, s.search_, s.targets_, s.backward_, s.clock_);
  }

 private:
  void detect(const Frame& z, const StepTime& at, TrackLog& log);

  MmPhdConfig config_;
  MotionBank bank_;
  TargetAppearance appearance_;
  PhdFilter search_;
  PeakFinder peaks_;
  FollowedTargets targets_;
  BackwardPass backward_;
  std::vector<Box> boxes_;
  PixelMask mask_;
  StepClock clock_;
};

}  // namespace glint

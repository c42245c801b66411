// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <tuple>
#include <vector>

#include "glint/engine/trackers/phd/followed_targets.hpp"
#include "glint/engine/trackers/phd/phd_filter.hpp"
#include "glint/engine/tracks/tracker.hpp"

namespace glint {

/// Settings of `mm-pf`.
struct MmPfConfig : PhdFilterConfig {
  MmPfConfig() {
    snr_low = 8, snr_high = 18;
    intensity_walk = 0.5;
    motion = "cv+ct";
  }
  double false_probability = 1e-5;  ///< P_F of the detection test
  double miss_probability = 0.05;   ///< P_M
  double cluster_radius = 0;        ///< [px]; 0 = auto, half the window
  int target_particles = 1500;
  double mask_half_width = 5;  ///< [px]; 0 = auto, half the window
  double separation = 6;       ///< [px]
  FollowedTargetsConfig known_targets() const;
};
void describe(FieldList& f, MmPfConfig& c);

/// Heuristic multi-target MM-PF track-before-detect, what P-PHD section 5.3 compares with: a search
/// cloud holds the posterior odds of one target more, Boers and Driessen's likelihood ratio test
/// declares it, its cluster becomes a particle filter of its own, and the search starts again
/// without it.
class MmPf : public TrackerOf<MmPf> {
 public:
  /// Throws ConfigError for settings that do not fit together.
  MmPf(const MmPfConfig& config, const Device& device, std::uint64_t seed);
  Feed feed() const override { return Feed::frames; }
  void step(const Scan& scan, TrackLog& log) override;
  std::vector<std::string> notes() const override { return {appearance_.note()}; }

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.appearance_, s.search_, s.targets_, s.clock_);
  }

 private:
  void search(const Frame& z, const StepTime& at, TrackLog& log);

  MmPfConfig config_;
  MotionBank bank_;
  TargetAppearance appearance_;
  PhdFilter search_;
  PeakFinder peaks_;
  FollowedTargets targets_;
  std::vector<Box> boxes_;
  PixelMask mask_;
  StepClock clock_;
};

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <tuple>
#include <vector>

#include "glint/engine/trackers/phd/detector.hpp"
#include "glint/engine/trackers/phd/followed_targets.hpp"
#include "glint/engine/tracks/tracker.hpp"

namespace glint {

/// Settings of `mm-pf`.
struct MmPfConfig : DetectorConfig, FollowedTargetsConfig {
  MmPfConfig() {
    rule = LifeRule::likelihood_ratio;
    confirm_hits = 1;
  }
  double false_probability = 1e-5;  ///< P_F of the detection test
};
void describe(FieldList& f, MmPfConfig& c);

/// Heuristic multi-target MM-PF track-before-detect, what P-PHD section 5.3 compares with: the
/// weights of a cluster of the detector's particles sum to the posterior odds of a target there,
/// Boers and Driessen's likelihood ratio test declares it, it starts a particle filter of its own,
/// and its particles leave the detector.
class MmPf : public TrackerOf<MmPf> {
 public:
  /// Throws ConfigError for settings that do not fit together.
  MmPf(const MmPfConfig& config, const Device& device, std::uint64_t seed);
  Feed feed() const override { return Feed::frames; }
  void step(const Scan& scan, TrackLog& log) override;
  std::vector<std::string> notes() const override { return {appearance_.note()}; }

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.appearance_, s.detector_, s.targets_, s.clock_);
  }

 private:
  void detect(const Frame& z, const StepTime& at, TrackLog& log);

  double declaring_odds_;
  std::vector<std::string> mode_names_;
  TargetAppearance appearance_;
  Detector detector_;
  FollowedTargets targets_;
  StepClock clock_;
};

}  // namespace glint

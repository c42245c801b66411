// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <tuple>
#include <vector>

#include "glint/engine/trackers/phd/backward_pass.hpp"
#include "glint/engine/trackers/phd/detector.hpp"
#include "glint/engine/trackers/phd/followed_targets.hpp"
#include "glint/engine/tracks/tracker.hpp"

namespace glint {

/// Settings of `mm-phd`. `existence` is also the least mass of a detected peak.
struct MmPhdConfig : DetectorConfig, FollowedTargetsConfig {
  int backward_frames = 12;  ///< [frame]; 0 = no backward pass
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
    return std::tie(s.appearance_, s.detector_, s.targets_, s.backward_, s.clock_);
  }

 private:
  void detect(const Frame& z, const StepTime& at, TrackLog& log);

  double least_mass_;  // of a peak
  std::vector<std::string> mode_names_;
  TargetAppearance appearance_;
  Detector detector_;
  FollowedTargets targets_;
  BackwardPass backward_;
  std::vector<BackwardPass::Position> positions_;  // of all tracks in the present frame
  StepClock clock_;
};

}  // namespace glint

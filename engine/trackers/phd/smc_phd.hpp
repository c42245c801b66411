// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "glint/engine/config.hpp"
#include "glint/engine/trackers/phd/adaptive_noise.hpp"
#include "glint/engine/trackers/phd/backward_pass.hpp"
#include "glint/engine/trackers/phd/identities.hpp"
#include "glint/engine/trackers/phd/peaks.hpp"
#include "glint/engine/trackers/phd/phd_filter.hpp"
#include "glint/engine/tracks/step_clock.hpp"
#include "glint/engine/tracks/tracker.hpp"
#include "glint/kernels/core/device.hpp"

namespace glint {

/// How the particles become targets: peaks, or the k-means of P-PHD section 3.1.
enum class StateExtraction { peaks, kmeans };

/// Settings of `smc-phd`.
struct SmcPhdConfig : PhdFilterConfig {
  SmcPhdConfig() { birth_growth = 4; }
  // How particles become targets.
  StateExtraction states = StateExtraction::peaks;
  double existence = 0.5;       ///< least mass of a target
  double cluster_radius = 0;    ///< half side of a target's box [px]; 0 = auto, half the window
  double noise_adaptation = 1;  ///< Qmax / Qmin; 1 = fixed
  IdentityConfig identity;
  int backward_frames = 0;  ///< a confirmed track is traced back this far before its first peak
};
void describe(FieldList& f, SmcPhdConfig& c);

/// The tracker of P-PHD section 3.2: process noise that adapts to each target (21), resampling on
/// the likelihood (24) and the backward recursion (25)-(27), with the settings of section 5.1
/// otherwise those of `smc-phd`.
struct SmcPhdImprovedConfig : SmcPhdConfig {
  SmcPhdImprovedConfig() {
    process_noise = 0.001;
    noise_adaptation = 50;
    resample_on = ResampleOn::likelihood;
    backward_frames = 12;
  }
};

/// SMC-PHD track-before-detect, the standard tracker of P-PHD section 3.1 and the improved one of
/// 3.2, with the corrections that make them work (docs/trackers/smc-phd.md), and identities that
/// persist.
class SmcPhd : public TrackerOf<SmcPhd> {
 public:
  /// Throws ConfigError for settings that do not fit together.
  SmcPhd(const SmcPhdConfig& config, const Device& device, std::uint64_t seed);
  Feed feed() const override { return Feed::frames; }
  void step(const Scan& scan, TrackLog& log) override;
  std::vector<std::string> notes() const override { return {appearance_.note()}; }

  /// Expected number of targets after the last step. P-PHD (19)
  double expected_targets() const { return filter_.expected(); }
  std::size_t particle_count() const { return filter_.size(); }

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.appearance_, s.filter_, s.identities_, s.noise_, s.backward_, s.clock_);
  }

 private:
  std::span<const std::uint32_t> find_peaks(const Scan& scan);
  void report(const Scan& scan, const StepTime& at, TrackLog& log);
  void trace_back(const Scan& scan, const StepTime& at, std::span<const Peak> found,
                  std::span<const std::uint32_t> members, TrackLog& log);

  SmcPhdConfig config_;
  std::uint64_t seed_;
  std::vector<std::string> mode_names_;
  TargetAppearance appearance_;
  PhdFilter filter_;
  PixelMask no_mask_;
  PeakFinder peaks_;
  std::vector<Peak> found_, faint_;  // in the present frame: targets, and what is less than one
  std::vector<std::uint32_t> kmeans_members_;
  Identities identities_;
  AdaptiveNoise noise_;
  BackwardPass backward_;
  std::vector<BackwardPass::Position> positions_;  // of all tracks in the present frame
  StepClock clock_;
};

}  // namespace glint

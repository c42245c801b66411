// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "glint/engine/config.hpp"
#include "glint/engine/filters/births.hpp"
#include "glint/engine/filters/identities.hpp"
#include "glint/engine/filters/peaks.hpp"
#include "glint/engine/trackers/tracker.hpp"
#include "glint/kernels/core/device.hpp"

namespace glint {

/// Settings of `smc-phd`. The unit of time is the frame interval, whatever the frame rate.
struct SmcPhdConfig {
  // What a target looks like.
  double psf_sigma = 1.0;             ///< [px]; 0 = auto
  double snr_low = 6, snr_high = 26;  ///< peak SNR [dB]
  double jitter = 0.2;                ///< [px]
  // How it moves.
  std::string motion = "cv";
  double process_noise = 0.02;  ///< [px^2/frame^3]
  double turn_rate = 15;        ///< [deg/frame]
  double speed_max = 4;         ///< [px/frame]
  double intensity_walk = 0.2;  ///< [noise sigmas of peak, per frame]
  double survival = 0.99;
  // Where it comes from.
  std::string birth = "two-frame";
  int birth_particles = 4000;
  double birth_mass = 0.05;
  double birth_threshold = 1.5;  ///< [noise sigmas]
  // How many particles stand for it.
  int particles_per_target = 2000;
  int particles_max = 2000000;
  std::string resampling = "systematic";
  // How the cloud becomes targets.
  std::string states = "peaks";
  std::string psi = "window";
  double clutter = 1;
  double existence = 0.5;
  double cluster_radius = 0;  ///< [px]; 0 = auto, half the window
  IdentityConfig identity;
};
void describe(FieldList& list, SmcPhdConfig& config);

/// SMC-PHD track-before-detect, the standard tracker of P-PHD section 3.1 with the corrections that
/// make it work (docs/trackers/smc-phd.md), and identities that persist.
class SmcPhd : public Tracker {
 public:
  /// Throws ConfigError for settings that do not fit together.
  SmcPhd(const SmcPhdConfig& config, const Device& device, std::uint64_t seed);
  Feed feed() const override { return Feed::frames; }
  void step(const Scan& scan, TrackLog& log) override;
  std::vector<std::string> notes() const override;

  /// Expected number of targets after the last step. P-PHD (19)
  double expected_targets() const { return expected_; }
  const Particles& particles() const { return particles_; }

 private:
  void set_up(double psf_sigma);
  void fit(const Scan& scan);
  void predict(std::int64_t frame, double step);
  void give_birth(const Scan& scan, double step);
  void update(const Scan& scan);
  void report(const Scan& scan, double step, TrackLog& log);
  void resample(std::int64_t frame);

  SmcPhdConfig config_;
  Device device_;
  std::uint64_t seed_;
  MotionBank bank_;
  PointSpread spread_;
  int seen_ = 0;         ///< frames looked at for the fit
  bool fitted_ = false;  ///< the point spread came from the data
  float intensity_low_ = 1, intensity_high_ = 1;
  std::unique_ptr<Births> births_;
  Particles particles_, moved_;
  std::size_t survivors_ = 0;
  AlignedVector<float> log_ratio_, updated_;
  CellWorkspace cells_;
  ResampleWorkspace draws_;
  PeakFinder peaks_;
  std::vector<std::uint32_t> kmeans_members_, ancestors_;
  Identities identities_;
  double expected_ = 0;
  std::int64_t last_frame_ = -1;
  double last_time_ = 0;
};

}  // namespace glint

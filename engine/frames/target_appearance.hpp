// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <tuple>
#include <vector>

#include "glint/engine/config.hpp"
#include "glint/engine/scan.hpp"
#include "glint/kernels/core/point_spread.hpp"

namespace glint {

/// What a target looks like.
struct AppearanceConfig {
  double psf_sigma = 1.0;             ///< [px]; 0 = auto
  double snr_low = 6, snr_high = 26;  ///< peak SNR [dB]
  double intensity_walk = 0.2;        ///< [noise sigmas of peak, per frame]
  double jitter = 0.2;                ///< [px]
};
void describe(FieldList& f, AppearanceConfig& c);
/// Lists psf_sigma, snr_low and snr_high alone.
void describe_shape(FieldList& f, AppearanceConfig& c);

/// The point spread and the range of intensities, given or fitted to the first frames.
class TargetAppearance {
 public:
  /// Throws ConfigError if snr_low exceeds snr_high.
  explicit TargetAppearance(const AppearanceConfig& config);

  /// Fits psf_sigma if it is 0 (auto); true if the appearance changed, as it does on the first
  /// call. The default point spread holds until a target is bright enough for the fit.
  bool look_at(const Scan& scan);
  const PointSpread& spread() const { return spread_; }
  /// Total intensity of the weakest and the strongest target [noise sigmas].
  float intensity_low() const { return intensity_low_; }
  float intensity_high() const { return intensity_high_; }
  /// Variance of the intensity's random walk [sigma^2/frame].
  float intensity_noise() const;
  float jitter() const { return static_cast<float>(config_.jitter); }
  /// Half side of the box that masks a target, without the middle pixel [px]; `given`, or half the
  /// window if that is 0 (auto).
  int mask_half_width(double given) const {
    return given > 0 ? static_cast<int>(given) : spread_.half_width;
  }
  /// Half side of the box that holds a target's particles [px]; `given`, or half the window's width
  /// if that is 0 (auto).
  double cluster_radius(double given) const { return given > 0 ? given : spread_.half_width + 0.5; }
  /// "psf_sigma = 1.04 px (fitted ...)".
  std::string note() const;

  template <class Self>
  static auto fields(Self& s) {
    // The settings, too: set_appearance() of a filter replaces them.
    return std::tie(s.config_.psf_sigma, s.config_.snr_low, s.config_.snr_high,
                    s.config_.intensity_walk, s.config_.jitter, s.spread_.sigma, s.intensity_low_,
                    s.intensity_high_, s.seen_, s.set_, s.fitted_);
  }
  void restored() { spread_ = PointSpread::of(spread_.sigma); }

 private:
  void set(double psf_sigma);

  AppearanceConfig config_;
  PointSpread spread_;
  float intensity_low_ = 1, intensity_high_ = 1;
  int seen_ = 0;  ///< frames looked at
  bool set_ = false, fitted_ = false;
};

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/frames/target_appearance.hpp"

#include <numbers>

#include "glint/engine/frames/point_spread_fit.hpp"
#include "glint/engine/number_text.hpp"

namespace glint {

void describe_shape(FieldList& f, AppearanceConfig& c) {
  f.automatic(
      "psf_sigma", c.psf_sigma, 0, 2.66, "px",
      "width of the point spread; auto fits it to the brightest local maxima of the first frames");
  f("snr_low", c.snr_low, -20, 80, "dB", "weakest target: peak over noise, 20 log10");
  f("snr_high", c.snr_high, -20, 80, "dB", "strongest target");
}

void describe(FieldList& f, AppearanceConfig& c) {
  describe_shape(f, c);
  f("intensity_walk", c.intensity_walk, 0, 100, "sigma",
    "how far a target's peak wanders from frame to frame, in noise sigmas");
  f("jitter", c.jitter, 0, 5, "px", "position error of the sensor, sampled per particle");
}

TargetAppearance::TargetAppearance(const AppearanceConfig& config) : config_(config) {
  if (config.snr_low > config.snr_high) {
    throw ConfigError("snr_low must not exceed snr_high: lower snr_low or raise snr_high");
  }
}

void TargetAppearance::set(double psf_sigma) {
  spread_ = PointSpread::of(psf_sigma);
  intensity_low_ = static_cast<float>(spread_.intensity_of_snr(config_.snr_low));
  intensity_high_ = static_cast<float>(spread_.intensity_of_snr(config_.snr_high));
  set_ = true;
}

// The first frames are not used: their background is not known yet, and its structure looks like
// targets.
bool TargetAppearance::look_at(const Scan& scan) {
  constexpr int kSettling = 15;
  if (config_.psf_sigma > 0 || fitted_) {
    if (set_) return false;
    set(config_.psf_sigma);
    return true;
  }
  const auto sigma =
      ++seen_ < kSettling ? std::nullopt : fit_point_spread(scan.whitened.view(), scan.raw.view());
  if (!sigma && set_) return false;
  fitted_ = sigma.has_value();
  set(sigma.value_or(AppearanceConfig{}.psf_sigma));
  return true;
}

float TargetAppearance::intensity_noise() const {
  const double walk = config_.intensity_walk * 2 * std::numbers::pi * spread_.sigma * spread_.sigma;
  return static_cast<float>(walk * walk);
}

std::string TargetAppearance::note() const {
  const std::string how = config_.psf_sigma > 0 ? "given"
                          : fitted_             ? "fitted to the brightest local maxima"
                                    : "the default: nothing was bright enough to fit it";
  return "psf_sigma = " + number_text(spread_.sigma) + " px (" + how + ")";
}

}  // namespace glint

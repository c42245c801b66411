// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/frames/target_appearance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "glint/engine/scenario/scenario.hpp"

namespace glint {
namespace {

AppearanceConfig config_of(double psf_sigma) {
  AppearanceConfig c;
  c.psf_sigma = psf_sigma, c.snr_low = 6, c.snr_high = 26;
  return c;
}

// P-PHD (5): a peak SNR of s dB is an intensity of 2 pi sigma^2 10^(s / 20).
TEST(TargetAppearance, TurnsPeakSnrIntoIntensity) {
  TargetAppearance a(config_of(0.7));
  EXPECT_TRUE(a.look_at(Scan{}));
  EXPECT_FALSE(a.look_at(Scan{}));
  const double unit = 2 * std::numbers::pi * 0.49;
  EXPECT_NEAR(a.intensity_low(), unit * std::pow(10, 0.3), 1e-4);
  EXPECT_NEAR(a.intensity_high(), unit * std::pow(10, 1.3), 1e-3);
}

// The walk is of the peak, the variance that of the whole target's intensity.
TEST(TargetAppearance, GivesTheVarianceOfTheIntensitysWalk) {
  AppearanceConfig config = config_of(0.7);
  config.intensity_walk = 0.3;
  TargetAppearance a(config);
  a.look_at(Scan{});
  EXPECT_NEAR(a.intensity_noise(), std::pow(0.3 * 2 * std::numbers::pi * 0.49, 2), 1e-5);
}

TEST(TargetAppearance, MeasuresBoxesByItsWindowUnlessTheyAreGiven) {
  TargetAppearance a(config_of(1.0));  // 7x7 pixels
  a.look_at(Scan{});
  EXPECT_EQ(a.mask_half_width(0), 3);
  EXPECT_EQ(a.mask_half_width(5), 5);
  EXPECT_EQ(a.cluster_radius(0), 3.5);
  EXPECT_EQ(a.cluster_radius(2.25), 2.25);
}

TEST(TargetAppearance, RefusesAnEmptyRangeOfSnr) {
  AppearanceConfig config = config_of(1);
  config.snr_low = 26.1;
  EXPECT_THROW(TargetAppearance{config}, ConfigError);
  config.snr_low = 26;
  EXPECT_NO_THROW(TargetAppearance{config});
}

/// A noise-free target of this width and peak [noise sigmas].
Scan scan_of(double sigma, double peak) {
  Scene scene;
  scene.width = scene.height = 40, scene.frames = 1, scene.noise_sigma = 0;
  scene.point_spread = PointSpread::of(sigma);
  const double intensity = scene.point_spread.intensity_of_snr(20 * std::log10(peak));
  scene.targets = {{0, 1, intensity, fly({20, 15, 0, 0})}};
  Scan scan;
  scan.whitened = Frame(render(scene, 1, 0));
  return scan;
}

TEST(TargetAppearance, FitsItsPointSpreadOnceTheBackgroundIsKnown) {
  TargetAppearance a(config_of(0));
  const Scan bright = scan_of(1.5, 30);
  EXPECT_TRUE(a.look_at(bright));
  EXPECT_EQ(a.spread().sigma, AppearanceConfig{}.psf_sigma);
  for (int frame = 1; frame < 14; ++frame) EXPECT_FALSE(a.look_at(bright)) << frame;
  EXPECT_TRUE(a.look_at(bright));
  EXPECT_NEAR(a.spread().sigma, 1.5, 0.051);
  EXPECT_NEAR(a.intensity_low(), a.spread().intensity_of_snr(6), 1e-3);
  EXPECT_FALSE(a.look_at(scan_of(0.8, 30)));  // once for all
  EXPECT_NE(a.note().find("fitted"), std::string::npos);
}

TEST(TargetAppearance, WaitsForATargetThatIsBrightEnough) {
  TargetAppearance a(config_of(0));
  for (int frame = 0; frame < 30; ++frame) a.look_at(scan_of(1.5, 3));
  EXPECT_EQ(a.spread().sigma, AppearanceConfig{}.psf_sigma);
  EXPECT_NE(a.note().find("default"), std::string::npos);
  EXPECT_TRUE(a.look_at(scan_of(1.5, 30)));
  EXPECT_NEAR(a.spread().sigma, 1.5, 0.051);
}

}  // namespace
}  // namespace glint

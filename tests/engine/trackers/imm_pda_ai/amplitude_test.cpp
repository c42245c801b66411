// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/imm_pda_ai/amplitude.hpp"

#include <gtest/gtest.h>

namespace glint {
namespace {

using enum AmplitudeModel;

TEST(Amplitude, TheTailOfANormalHoldsFarOut) {
  EXPECT_NEAR(log_normal_tail(0), std::log(0.5), 1e-15);
  EXPECT_NEAR(log_normal_tail(1.959963984540054), std::log(0.025), 1e-12);
  EXPECT_NEAR(log_normal_tail(-40), 0, 1e-15);
  EXPECT_NEAR(log_normal_tail(25), log_normal_tail(std::nextafter(25, 0)), 1e-7);
  EXPECT_NEAR(log_normal_tail(30), -454.3212439563, 1e-6);
  EXPECT_TRUE(std::isfinite(log_normal_tail(1000)));
}

/// Of clutter, given that it exceeds t.
double clutter_density(AmplitudeModel model, double a, double t) {
  if (model == rayleigh) return a * std::exp((t * t - a * a) / 2);
  return std::exp(-a * a / 2) / std::sqrt(2 * std::numbers::pi) / std::exp(log_normal_tail(t));
}

// The ratio times the density of clutter is the density of the target, which must have unit mass
// above the threshold.
TEST(Amplitude, TheRatioIsOfTwoDensitiesAboveTheThreshold) {
  for (const AmplitudeModel model : {rayleigh, gaussian}) {
    for (const double mean : {1.0, 4.0, 8.0}) {
      for (const double t : {0.0, 1.5, 3.0}) {
        const TargetAmplitude target(mean);
        double mass = 0;
        constexpr double kStep = 1e-3;
        for (double a = t + kStep / 2; a < 35; a += kStep) {
          mass += kStep * clutter_density(model, a, t) * std::exp(target.log_ratio(model, a, t));
        }
        EXPECT_NEAR(mass, 1, 1e-5) << mean << " above " << t;
      }
    }
  }
}

TEST(Amplitude, RayleighByHand) {
  const TargetAmplitude target(std::sqrt(std::numbers::pi / 2 * 5));  // of power 1 + d = 5
  EXPECT_NEAR(target.log_ratio(rayleigh, 4, 2), (16 - 4) / 2.0 * 4 / 5 - std::log(5), 1e-13);
  EXPECT_NEAR(TargetAmplitude(0.1).log_ratio(rayleigh, 4, 2), 0, 1e-15);  // no weaker than clutter
}

TEST(Amplitude, GaussianByHand) {
  // At the mean of a target far above the threshold, of spread 1.
  EXPECT_NEAR(TargetAmplitude(3).log_ratio(gaussian, 3, -30), 4.5, 1e-12);
  EXPECT_NEAR(TargetAmplitude(3).log_ratio(gaussian, 5, -30), 12.5 - 2, 1e-12);
}

TEST(Amplitude, SaysNothingIfNotUsed) { EXPECT_EQ(TargetAmplitude(3).log_ratio(none, 7, 1), 0); }

TEST(Amplitude, WhatLiesUnderTheThresholdCountsAsOnIt) {
  for (const AmplitudeModel model : {rayleigh, gaussian}) {
    const TargetAmplitude target(5);
    EXPECT_EQ(target.log_ratio(model, 1, 2), target.log_ratio(model, 2, 2));
  }
}

TEST(Amplitude, LearnsAFifthOfWhatIsCertain) {
  TargetAmplitude target(10);
  target.update(20, 1);
  EXPECT_DOUBLE_EQ(target.mean(), 12);
  target.update(22, 0.5);
  EXPECT_DOUBLE_EQ(target.mean(), 13);
}

// Why both models follow an extended target by its brightest unit: that a unit of 28 sigmas be
// clutter is beyond all measure, whatever the target's own density says.
TEST(Amplitude, OfTwoPointsFarAboveClutterTheBrighterTakesAll) {
  const TargetAmplitude target(28);
  for (const AmplitudeModel model : {rayleigh, gaussian}) {
    EXPECT_GT(target.log_ratio(model, 30, 5) - target.log_ratio(model, 28, 5), 50);
  }
}

}  // namespace
}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/particle_steps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "engine/trackers/phd/few_particles.hpp"
#include "glint/engine/errors.hpp"

namespace glint {
namespace {

using namespace test;

constexpr double kStepRatio = 30;

struct Model {
  MotionBank bank = exact_motion().bank();
  TargetAppearance appearance = ready(exact_appearance(kStepRatio));
  Device device = Device::serial();
  ParticleModel get() const { return {bank, appearance, device, 1}; }
};

TEST(ParticleSteps, MoveAtConstantVelocityForThatManyFrames) {
  const auto intensity = static_cast<float>(intensity_of_ratio(kStepRatio));
  Particles p = particles_of({{.x = 3, .y = 4, .vx = 1.5F, .vy = -2, .intensity = intensity}});
  move_particles(Model().get(), 7, 2, p);
  EXPECT_NEAR(p.x[0], 6, 1e-6);
  EXPECT_NEAR(p.y[0], 0, 1e-6);
  EXPECT_NEAR(p.vx[0], 1.5, 1e-6);
  EXPECT_NEAR(p.vy[0], -2, 1e-6);
  EXPECT_NEAR(p.intensity[0], intensity, 1e-4);
}

// P-PHD (31) with q: a step of T moves the position's variance by q T^3 / 3, times noise_scale^2.
TEST(ParticleSteps, SpreadByTheProcessNoiseAndItsScale) {
  Model model;
  model.bank = motion_bank("cv", 0.3, 0);
  constexpr std::size_t kHalf = 4000;
  Particles p = particles_of(std::vector<TestParticle>(2 * kHalf));
  std::vector<float> scale(2 * kHalf, 1);
  std::fill(scale.begin() + kHalf, scale.end(), 3.0F);
  move_particles(model.get(), 1, 2, p, scale);
  double variance[2] = {0, 0};
  for (std::size_t i = 0; i < p.size(); ++i) variance[i / kHalf] += p.x[i] * p.x[i] / kHalf;
  EXPECT_NEAR(variance[0], 0.3 * 8 / 3, 0.08);
  EXPECT_NEAR(variance[1], 9 * 0.3 * 8 / 3, 0.7);
}

TEST(ParticleSteps, WalkTheIntensityWithinItsRange) {
  Model model;
  AppearanceConfig config;
  config.psf_sigma = 0.7, config.snr_low = 6, config.snr_high = 26, config.intensity_walk = 0.3;
  model.appearance = ready(config);
  const auto start = static_cast<float>(narrow_spread().intensity_of_snr(16));
  constexpr std::size_t kCount = 4000;
  Particles p = particles_of(std::vector<TestParticle>(kCount, {.intensity = start}));
  move_particles(model.get(), 1, 4, p);
  double variance = 0;
  for (const float i : p.intensity) variance += (i - start) * (i - start) / kCount;
  // A walk of .3 sigmas of peak a frame; the whole target is 2 pi sigma^2 times its peak.
  const double per_frame = 0.3 * narrow_spread().intensity_of_snr(0);
  EXPECT_NEAR(variance / (4 * per_frame * per_frame), 1, 0.1);
}

// P-PHD (13): I^2 B / 2 in the target's own image, minus that in an empty frame.
TEST(ParticleSteps, WeighByTheLikelihoodRatio) {
  const auto intensity = static_cast<float>(intensity_of_ratio(kStepRatio));
  const Particles p = particles_of({{.x = 20, .y = 15, .intensity = intensity},
                                    {.x = 5, .y = 5, .intensity = intensity},
                                    {.x = -1, .y = 5, .intensity = intensity}});
  std::vector<float> log_ratio(3);
  weigh_particles(Model().get(), image_of(kStepRatio, {{20, 15}}), 1, p, log_ratio);
  EXPECT_NEAR(log_ratio[0], std::log(kStepRatio), 1e-4);
  EXPECT_NEAR(log_ratio[1], -std::log(kStepRatio), 1e-4);
  EXPECT_EQ(log_ratio[2], -std::numeric_limits<float>::infinity());
}

TEST(ParticleSteps, SampleTheSensorsJitter) {
  Model model;
  AppearanceConfig config = exact_appearance(kStepRatio);
  config.jitter = 0.3;
  model.appearance = ready(config);
  const auto intensity = static_cast<float>(intensity_of_ratio(kStepRatio));
  const Particles p =
      particles_of(std::vector<TestParticle>(20, {.x = 20, .y = 15, .intensity = intensity}));
  std::vector<float> now(20), again(20), next(20);
  const Frame z = image_of(kStepRatio, {{20, 15}});
  weigh_particles(model.get(), z, 1, p, now);
  weigh_particles(model.get(), z, 1, p, again);
  weigh_particles(model.get(), z, 2, p, next);
  EXPECT_EQ(now, again);
  EXPECT_NE(now, next);
  EXPECT_NE(now[0], now[1]);
}

TEST(ParticleSteps, RefuseParticlesThatCannotBe) {
  const Particles good = particles_of({{.x = 1, .mode = 2}, {.y = 2}});
  EXPECT_NO_THROW(require_particles(good, 3));
  EXPECT_THROW(require_particles(good, 2), BytesError);
  const auto refused = [&](auto&& change) {
    Particles p = good;
    change(p);
    EXPECT_THROW(require_particles(p, 3), BytesError);
  };
  refused([](Particles& p) { p.label.resize(1); });
  refused([](Particles& p) { p.x[1] = std::nanf(""); });
  refused([](Particles& p) { p.vy[0] = 2e9F; });
  refused([](Particles& p) { p.weight[0] = -1; });
  refused([](Particles& p) { p.weight[1] = std::numeric_limits<float>::infinity(); });
}

}  // namespace
}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/target_filters.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "engine/trackers/phd/few_particles.hpp"
#include "glint/engine/scenario/scenario.hpp"

namespace glint {
namespace {

constexpr int kPerTarget = 2000;

TargetAppearance appearance() {
  AppearanceConfig config;
  config.psf_sigma = 0.7, config.snr_low = 14, config.snr_high = 18, config.jitter = 0;
  TargetAppearance a(config);
  a.look_at(Scan{});
  return a;
}

/// Particles about a state, all of one weight.
Particles around(double x, double y, double vx, double vy) {
  Particles p;
  p.resize(kPerTarget);
  const RandomKey key = random_key(9, 0, Purpose::trial);
  const auto peak = static_cast<float>(PointSpread::of(0.7).intensity_of_snr(16));
  for (std::uint32_t i = 0; i < kPerTarget; ++i) {
    const Normals4 n = random_normals(key, i);
    p.x[i] = static_cast<float>(x) + 0.3f * n.n[0], p.y[i] = static_cast<float>(y) + 0.3f * n.n[1];
    p.vx[i] = static_cast<float>(vx) + 0.1f * n.n[2];
    p.vy[i] = static_cast<float>(vy) + 0.1f * n.n[3];
    p.ax[i] = p.ay[i] = 0;
    p.intensity[i] = peak, p.weight[i] = 1, p.mode[i] = 0, p.label[i] = 0;
  }
  return p;
}

std::vector<std::uint32_t> all_of(const Particles& p) {
  std::vector<std::uint32_t> members(p.size());
  std::iota(members.begin(), members.end(), 0u);
  return members;
}

TargetFilters filters_of(const MotionBank& bank) {
  TargetFilters c(bank, kPerTarget, Device::tbb(2), 5);
  c.set_appearance(appearance());
  return c;
}

Scene two_targets() {
  Scene s;
  s.width = 60, s.height = 40, s.frames = 12;
  s.point_spread = PointSpread::of(0.7);
  const double intensity = s.point_spread.intensity_of_snr(16);
  s.targets = {{0, 12, intensity, fly({8, 10, 0.9, 0.3})},
               {0, 12, intensity, fly({50, 30, -0.8, 0.2})}};
  return s;
}

TEST(TargetFilters, FollowsEachTargetWithItsOwnParticles) {
  const Scene scene = two_targets();
  TargetFilters c = filters_of(motion_bank("cv", 1e-3, 0));
  for (const auto& t : truth_at(scene, 0)) {
    const Particles p = around(t.x, t.y, t.vx, t.vy);
    c.add(p, all_of(p), 0);
  }
  for (int k = 1; k < scene.frames; ++k) {
    const Frame z(render(scene, 3, k));
    c.predict(k, 1);
    const auto updates = c.update(z, k);
    ASSERT_EQ(updates.size(), 2u);
    const auto truth = truth_at(scene, k);
    for (std::size_t t = 0; t < 2; ++t) {
      EXPECT_GT(updates[t].mean_ratio, 10);
      EXPECT_NEAR(updates[t].estimate.x, truth[t].x, 0.8);
      EXPECT_NEAR(updates[t].estimate.y, truth[t].y, 0.8);
    }
    c.resample(k);
  }
}

TEST(TargetFilters, AnswersForOneTargetDoNotDependOnTheOthersBehindIt) {
  const Scene scene = two_targets();
  const auto first = truth_at(scene, 0)[0];
  const Particles p = around(first.x, first.y, first.vx, first.vy);
  TargetFilters alone = filters_of(motion_bank("cv", 1e-3, 0));
  TargetFilters beside = filters_of(motion_bank("cv", 1e-3, 0));
  alone.add(p, all_of(p), 0);
  beside.add(p, all_of(p), 0);
  beside.add(p, all_of(p), 0);
  const Frame z(render(scene, 3, 1));
  alone.predict(1, 1);
  beside.predict(1, 1);
  EXPECT_EQ(alone.update(z, 1)[0].estimate.x, beside.update(z, 1)[0].estimate.x);
}

TEST(TargetFilters, NoiseAloneMakesTheMeanRatioSmall) {
  Scene scene = two_targets();
  const Particles p = around(30, 20, 0, 0);
  scene.targets.clear();
  TargetFilters c = filters_of(motion_bank("cv", 1e-3, 0));
  c.add(p, all_of(p), 0);
  c.predict(1, 1);
  EXPECT_LT(c.update(Frame(render(scene, 3, 1)), 1)[0].mean_ratio, 0.5);
}

TEST(TargetFilters, OutOfViewHasNoEstimate) {
  const Particles p = around(-50, 20, 0, 0);
  TargetFilters c = filters_of(motion_bank("cv", 1e-3, 0));
  c.add(p, all_of(p), 0);
  const auto update = c.update(Frame(Image<float>(40, 40)), 1)[0];
  EXPECT_EQ(update.mean_ratio, 0);
  EXPECT_EQ(update.estimate.mass, 0);
}

constexpr double kFilterRatio = 50;

/// Particles that a target's likelihood ratio is known for, in filters of that many a target.
TargetFilters exact_filters(int count) {
  TargetFilters f(test::exact_motion().bank(), count, Device::serial(), 5);
  f.set_appearance(test::ready(test::exact_appearance(kFilterRatio)));
  return f;
}
test::TestParticle exact_particle(float x, float vx = 0) {
  const auto intensity = static_cast<float>(test::intensity_of_ratio(kFilterRatio));
  return {.x = x, .y = 15, .vx = vx, .intensity = intensity};
}

// Half the particles where the target is, half where it is not: L = (l + 1 / l) / 2, P-PHD (13),
// and the weights of the estimate are l and 1 / l.
TEST(TargetFilters, UpdatesByTheMeanLikelihoodRatioAndTheWeightedMean) {
  TargetFilters f = exact_filters(4);
  const Particles p = test::particles_of({exact_particle(12, 1), exact_particle(30, -1)});
  f.add(p, all_of(p), 0);
  const TargetUpdate update = f.update(test::image_of(kFilterRatio, {{12, 15}}), 1)[0];
  EXPECT_NEAR(update.mean_ratio, (kFilterRatio + 1 / kFilterRatio) / 2, 1e-2);
  const double share = 1 / (1 + kFilterRatio * kFilterRatio);
  EXPECT_NEAR(update.estimate.x, 12 + 18 * share, 1e-4);
  EXPECT_NEAR(update.estimate.vx, 1 - 2 * share, 1e-4);
  EXPECT_EQ(update.estimate.mass, 1);
  f.resample(1);
  for (const float x : f.particles().x) EXPECT_EQ(x, 12);
}

TEST(TargetFilters, ParticlesKeepTheirPeakUnderAnotherPointSpread) {
  TargetFilters f = exact_filters(4);
  const Particles p = test::particles_of({exact_particle(12)});
  f.add(p, all_of(p), 0);
  AppearanceConfig wider = test::exact_appearance(kFilterRatio);
  wider.psf_sigma = 1.4;
  f.set_appearance(test::ready(wider));
  // A target of one peak has an intensity in proportion to sigma^2, P-PHD (5).
  for (const float i : f.particles().intensity) {
    EXPECT_NEAR(i, 4 * test::intensity_of_ratio(kFilterRatio), 1e-3);
  }
}

TEST(TargetFilters, AddDrawsFromTheMembersByTheirWeight) {
  TargetFilters f = exact_filters(100);
  Particles p = test::particles_of({exact_particle(10), exact_particle(20), exact_particle(30)});
  p.weight = {0.3F, 7, 0.1F};
  const std::vector<std::uint32_t> members{0, 2};
  f.add(p, members, 0);
  EXPECT_NEAR(static_cast<double>(std::ranges::count(f.particles().x, 10.0F)), 75, 1);
  EXPECT_NEAR(static_cast<double>(std::ranges::count(f.particles().x, 30.0F)), 25, 1);
}

// Two like targets of unlike weights: systematic draws of one random number would be the same.
TEST(TargetFilters, EachTargetDrawsItsOwnRandomNumbers) {
  constexpr int kFew = 25;
  std::vector<test::TestParticle> list(kFew);
  float next = 11.2F;
  for (auto& particle : list) particle = exact_particle(next += 0.07F);
  const Particles p = test::particles_of(list);
  TargetFilters one = exact_filters(kFew), two = exact_filters(kFew);
  one.add(p, all_of(p), 0);
  two.add(one, 0), two.add(one, 0);
  two.update(test::image_of(kFilterRatio, {{12, 15}}), 1);
  two.resample(1);
  const auto& x = two.particles().x;
  EXPECT_FALSE(std::equal(x.begin(), x.begin() + kFew, x.begin() + kFew));
}

TEST(TargetFilters, ReversingTurnsBothVelocities) {
  TargetFilters f = exact_filters(2);
  Particles p = test::particles_of({exact_particle(12, 1.5F)});
  p.vy[0] = -2;
  f.add(p, all_of(p), 0);
  f.reverse_velocities();
  f.predict(1, 2);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(f.particles().x[i], 12 - 3, 1e-5);
    EXPECT_NEAR(f.particles().y[i], 15 + 4, 1e-5);
  }
}

TEST(TargetFilters, RemovingMovesTheLaterOnesUp) {
  TargetFilters c = filters_of(motion_bank("cv", 1e-3, 0));
  for (const double x : {10.0, 20.0, 30.0}) {
    const Particles p = around(x, 20, 0, 0);
    c.add(p, all_of(p), 0);
  }
  c.remove(1);
  ASSERT_EQ(c.size(), 2u);
  EXPECT_NEAR(c.particles().x[0], 10, 2);
  EXPECT_NEAR(c.particles().x[kPerTarget], 30, 2);
}

TEST(TargetFilters, TimeTurnedRoundLeadsBackToTheStart) {
  // No process noise: a turn there and back ends where it began.
  const MotionBank bank = motion_bank("cv+ct", 0, 0.2);
  TargetFilters there = filters_of(bank);
  Particles p = around(20, 20, 1, 0.5);
  for (auto& mode : p.mode) mode = 1;
  MotionBank stay = bank;
  stay.switching = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  there = filters_of(stay);
  there.add(p, all_of(p), 0);
  const std::vector<float> x0(there.particles().x.begin(), there.particles().x.end());
  for (int k = 1; k <= 5; ++k) there.predict(k, 1);
  TargetFilters back = filters_of(reversed(stay));
  back.add(there, 0);
  back.reverse_velocities();
  for (int k = 1; k <= 5; ++k) back.predict(k, 1);
  for (std::size_t i = 0; i < x0.size(); i += 97) {
    EXPECT_NEAR(back.particles().x[i], x0[i], 1e-3);
  }
}

}  // namespace
}  // namespace glint

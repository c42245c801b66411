// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/target_filters.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "glint/engine/scenario/scenario.hpp"
#include "glint/engine/trackers/phd/pixel_mask.hpp"

namespace glint {
namespace {

constexpr int kCount = 2000;

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
  p.resize(kCount);
  const RandomKey key = random_key(9, 0, Purpose::trial);
  const auto peak = static_cast<float>(PointSpread::of(0.7).intensity_of_snr(16));
  for (std::uint32_t i = 0; i < kCount; ++i) {
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

TargetFilters clouds(const MotionBank& bank) {
  TargetFilters c(bank, kCount, Device::tbb(2), 5);
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

TEST(TargetFilters, FollowsEachTargetWithItsOwnCloud) {
  const Scene scene = two_targets();
  TargetFilters c = clouds(motion_bank("cv", 1e-3, 0));
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
  TargetFilters alone = clouds(motion_bank("cv", 1e-3, 0));
  TargetFilters beside = clouds(motion_bank("cv", 1e-3, 0));
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
  TargetFilters c = clouds(motion_bank("cv", 1e-3, 0));
  c.add(p, all_of(p), 0);
  c.predict(1, 1);
  EXPECT_LT(c.update(Frame(render(scene, 3, 1)), 1)[0].mean_ratio, 0.5);
}

TEST(TargetFilters, OutOfViewHasNoEstimate) {
  const Particles p = around(-50, 20, 0, 0);
  TargetFilters c = clouds(motion_bank("cv", 1e-3, 0));
  c.add(p, all_of(p), 0);
  const auto update = c.update(Frame(Image<float>(40, 40)), 1)[0];
  EXPECT_EQ(update.mean_ratio, 0);
  EXPECT_EQ(update.estimate.mass, 0);
}

TEST(TargetFilters, RemovingMovesTheLaterOnesUp) {
  TargetFilters c = clouds(motion_bank("cv", 1e-3, 0));
  for (const double x : {10.0, 20.0, 30.0}) {
    const Particles p = around(x, 20, 0, 0);
    c.add(p, all_of(p), 0);
  }
  c.remove(1);
  ASSERT_EQ(c.size(), 2u);
  EXPECT_NEAR(c.particles().x[0], 10, 2);
  EXPECT_NEAR(c.particles().x[kCount], 30, 2);
}

TEST(TargetFilters, TimeTurnedRoundLeadsBackToTheStart) {
  // No process noise: a turn there and back ends where it began.
  const MotionBank bank = motion_bank("cv+ct", 0, 0.2);
  TargetFilters there = clouds(bank);
  Particles p = around(20, 20, 1, 0.5);
  for (auto& mode : p.mode) mode = 1;
  MotionBank stay = bank;
  stay.switching = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  there = clouds(stay);
  there.add(p, all_of(p), 0);
  const std::vector<float> x0(there.particles().x.begin(), there.particles().x.end());
  for (int k = 1; k <= 5; ++k) there.predict(k, 1);
  TargetFilters back = clouds(reversed(stay));
  back.add(there, 0);
  back.reverse_velocities();
  for (int k = 1; k <= 5; ++k) back.predict(k, 1);
  for (std::size_t i = 0; i < x0.size(); i += 97) {
    EXPECT_NEAR(back.particles().x[i], x0[i], 1e-3);
  }
}

TEST(MotionBank, ReversedRowsAreProbabilitiesAndBayes) {
  const MotionBank bank = motion_bank("cv+ct", 1e-3, 0.2);
  const MotionBank back = reversed(bank);
  // Stationary shares of P-PHD (39): (.6, .2, .2).
  const double share[3] = {0.6, 0.2, 0.2};
  for (std::size_t j = 0; j < 3; ++j) {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      sum += back.switching[j * 3 + i];
      EXPECT_NEAR(share[j] * back.switching[j * 3 + i], share[i] * bank.switching[i * 3 + j], 1e-6);
    }
    EXPECT_NEAR(sum, 1, 1e-6);
  }
  EXPECT_EQ(back.modes[1].turn_rate, -bank.modes[1].turn_rate);
}

TEST(PixelMask, CoversItsBoxesAndForgetsTheOldOnes) {
  PixelMask mask;
  mask.set(std::vector<Box>{{2, 3, 5, 6}, {-4, -4, 1, 1}}, 10, 8);
  EXPECT_TRUE(mask.covers(2.4f, 3.4f));
  EXPECT_TRUE(mask.covers(0, 0));
  EXPECT_FALSE(mask.covers(5, 3));
  EXPECT_FALSE(mask.covers(-1, -1));
  EXPECT_FALSE(mask.covers(std::nanf(""), 3));
  mask.set({}, 10, 8);
  EXPECT_TRUE(mask.empty());
  EXPECT_FALSE(mask.covers(2.4f, 3.4f));
}

}  // namespace
}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/phd_filter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "engine/trackers/phd/few_particles.hpp"

namespace glint {
namespace {

using namespace test;

constexpr double kMass = 1;  // of the births in one frame
constexpr int kCount = 2000;

/// Births lie around the pixels above 1; targets are so dim that l = 1 within a thousandth.
PhdFilterConfig config_of(double ratio = 1 + 1e-6) {
  PhdFilterConfig c;
  static_cast<AppearanceConfig&>(c) = exact_appearance(ratio);
  static_cast<MotionConfig&>(c) = exact_motion();
  c.speed_max = 0.01;
  c.birth = BirthProposal::uniform, c.birth_particles = kCount, c.birth_mass = kMass,
  c.birth_threshold = 1;
  c.particles_per_target = 500;
  return c;
}

class Filter {
 public:
  explicit Filter(const PhdFilterConfig& config, WeightSum sum = WeightSum::expected_targets)
      : phd(config, Device::serial(), 1, sum) {
    phd.set_appearance(ready(config));
  }
  void update(const Frame& z, double step = 1) {
    phd.predict(z, ++frame, step, mask);
    phd.update(z, frame);
  }
  double sum_of_weights() {
    const auto& weight = phd.particles().weight;
    return std::accumulate(weight.begin(), weight.end(), 0.0);
  }
  PhdFilter phd;
  PixelMask mask;
  std::int64_t frame = 0;
};

Frame bright_at(const std::vector<Pixel>& pixels) {
  Image<float> image(kSide, kSide);
  for (const Pixel& p : pixels) image.view()(p.x, p.y) = 1.001F;
  return Frame(std::move(image));
}

// All particles lie in one window and l = 1, so P-PHD (14) and (19) give n = gamma / (1 + gamma).
TEST(PhdFilter, SharesAPixelAmongItsParticles) {
  Filter f(config_of());
  f.update(bright_at({{20, 15}}));
  EXPECT_EQ(f.phd.size(), kCount);
  EXPECT_NEAR(f.phd.expected(), 0.5, 1e-3);
  EXPECT_NEAR(f.sum_of_weights(), f.phd.expected(), 1e-5);
}

TEST(PhdFilter, DividesByTheClutter) {
  PhdFilterConfig config = config_of();
  config.clutter = 3;
  Filter f(config);
  f.update(bright_at({{20, 15}}));
  EXPECT_NEAR(f.phd.expected(), 1.0 / (3 + 1), 1e-3);
}

// As printed in P-PHD (15)-(16): each of the nine pixels shares its own ninth of gamma alone.
TEST(PhdFilter, OfCellsSharesEachPixelByItself) {
  PhdFilterConfig config = config_of();
  config.psi = Psi::cell;
  Filter f(config);
  f.update(bright_at({{20, 15}}));
  EXPECT_NEAR(f.phd.expected(), 9 * (1.0 / 9) / (1 + 1.0 / 9), 5e-3);
}

// P-PHD (11): survivors keep e w, so n' = e n / (1 + e n) with no births and l = 1.
TEST(PhdFilter, LetsTargetsSurviveWithTheirProbability) {
  PhdFilterConfig config = config_of();
  config.survival = 0.5;
  Filter f(config);
  f.update(bright_at({{20, 15}}));
  f.phd.resample(f.frame);
  f.update(empty_frame());
  EXPECT_NEAR(f.phd.expected(), 0.25 / 1.25, 1e-3);
}

TEST(PhdFilter, AddsTheNewBornToTheSurvivors) {
  PhdFilterConfig config = config_of();
  config.survival = 0.5;
  Filter f(config);
  f.update(bright_at({{20, 15}}));
  f.phd.resample(f.frame);
  const std::size_t survivors = f.phd.size();
  f.update(bright_at({{20, 15}}));
  EXPECT_EQ(f.phd.size(), survivors + kCount);
  EXPECT_NEAR(f.phd.expected(), 1.25 / 2.25, 1e-3);
}

// P-PHD (20): equal weights, their sum kept; particles_per_target for each begun target.
TEST(PhdFilter, ResamplesToEqualWeightsOfTheSameSum) {
  Filter f(config_of());
  f.update(bright_at({{20, 15}, {5, 30}, {35, 4}}));
  const double n = f.phd.expected();
  EXPECT_NEAR(n, 3 * (1.0 / 3) / (1 + 1.0 / 3), 5e-3);  // a third of gamma at each
  f.phd.resample(f.frame);
  EXPECT_EQ(f.phd.size(), 500U);
  PhdFilterConfig many = config_of();
  many.birth_mass = 6;
  Filter g(many);
  g.update(bright_at({{20, 15}, {5, 30}, {35, 4}}));
  EXPECT_NEAR(g.phd.expected(), 2, 2e-2);
  const double before = g.phd.expected();
  g.phd.resample(g.frame);
  EXPECT_EQ(g.phd.size(), 500U * static_cast<std::size_t>(std::ceil(before)));
  for (const float w : g.phd.particles().weight) {
    ASSERT_NEAR(w, before / static_cast<double>(g.phd.size()), 1e-7);
  }
}

TEST(PhdFilter, KeepsNoMoreThanTheMostParticles) {
  PhdFilterConfig config = config_of();
  config.particles_max = 120;
  Filter f(config);
  f.update(bright_at({{20, 15}}));
  f.phd.resample(f.frame);
  EXPECT_EQ(f.phd.size(), 120U);
}

TEST(PhdFilter, MovesItsParticlesAtTheirVelocities) {
  PhdFilterConfig config = config_of();
  config.speed_max = 2;
  Filter f(config);
  f.update(bright_at({{20, 15}}));
  f.phd.resample(f.frame);
  const Particles before = f.phd.particles();
  f.update(empty_frame(), 2);
  const Particles& after = f.phd.particles();
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < after.size(); ++i) {
    ASSERT_NEAR(after.x[i], before.x[i] + 2 * before.vx[i], 1e-4);
    ASSERT_NEAR(after.y[i], before.y[i] + 2 * before.vy[i], 1e-4);
  }
}

/// The particles left and right of x = 20.
std::vector<std::uint32_t> members_on(const Particles& p, bool left) {
  std::vector<std::uint32_t> members;
  for (std::uint32_t i = 0; i < p.size(); ++i) {
    if ((p.x[i] < 20) == left) members.push_back(i);
  }
  return members;
}

TEST(PhdFilter, RemovesParticlesWithTheirShareOfTheTargets) {
  for (const ResampleOn resample_on : {ResampleOn::weight, ResampleOn::likelihood}) {
    PhdFilterConfig config = config_of();
    config.resample_on = resample_on;
    Filter f(config);
    f.update(bright_at({{10, 15}, {30, 15}}));
    const double n = f.phd.expected();
    f.phd.remove(members_on(f.phd.particles(), true));
    EXPECT_NEAR(f.phd.expected(), n / 2, 0.05 * n);
    EXPECT_NEAR(f.phd.expected(), f.sum_of_weights(), 1e-5);
    const double left = f.phd.expected();
    f.phd.resample(f.frame);
    EXPECT_NEAR(f.sum_of_weights(), left, 1e-5);
    for (const float x : f.phd.particles().x) ASSERT_GT(x, 20) << static_cast<int>(resample_on);
  }
}

TEST(PhdFilter, IsEmptyAfterAllItsParticlesWereRemoved) {
  Filter f(config_of());
  f.update(bright_at({{10, 15}}));
  f.phd.remove(all_members(f.phd.particles()));
  EXPECT_NEAR(f.phd.expected(), 0, 1e-6);
  f.update(empty_frame());
  EXPECT_EQ(f.phd.expected(), 0);
  f.phd.resample(f.frame);
  EXPECT_EQ(f.phd.size(), 0U);
}

TEST(PhdFilter, LetsNothingLiveInTheMask) {
  Filter f(config_of());
  f.update(bright_at({{10, 15}, {30, 15}}));
  f.phd.resample(f.frame);
  const double n = f.phd.expected();
  f.mask.set(std::vector<Box>{{0, 0, 20, kSide}}, kSide, kSide);
  f.update(empty_frame());
  const double half = 0.99 * n / 2;
  EXPECT_NEAR(f.phd.expected(), half / (1 + half), 0.02);
  const Particles& p = f.phd.particles();
  for (const auto i : members_on(p, true)) ASSERT_EQ(p.weight[i], 0);
}

// The weights are w l alone, without the normaliser; expected() is that of the normaliser.
TEST(PhdFilter, OfOddsSumsWeightTimesLikelihood) {
  Filter f(config_of(), WeightSum::odds);
  f.update(bright_at({{20, 15}}));
  EXPECT_NEAR(f.sum_of_weights(), kMass, 1e-3);
  EXPECT_NEAR(total_mass(f.phd.runs()), kMass, 1e-3);
  EXPECT_NEAR(f.phd.expected(), kMass / (1 + kMass), 1e-3);
  f.phd.resample(f.frame);
  EXPECT_EQ(f.phd.size(), 500U);
  EXPECT_NEAR(f.sum_of_weights(), kMass, 1e-3);
  f.update(empty_frame());
  EXPECT_NEAR(f.sum_of_weights(), 0.99 * kMass, 1e-3);
}

TEST(PhdFilter, OfOddsStaysInTheRangeOfFloats) {
  PhdFilterConfig config = config_of(1e6);
  config.birth_mass = 1000;
  Filter f(config, WeightSum::odds);
  const Frame z = image_of(1e6, {{20, 15}});
  for (int k = 0; k < 20; ++k) {
    f.update(z);
    EXPECT_TRUE(std::isfinite(f.sum_of_weights()) && std::isfinite(f.phd.expected())) << k;
    EXPECT_GT(f.sum_of_weights(), 1);
    f.phd.resample(f.frame);
    ASSERT_GT(f.phd.size(), 0u) << k;
  }
}

TEST(PhdFilter, OfOddsOutlivesTheRemovalOfAllItsParticles) {
  Filter f(config_of(), WeightSum::odds);
  f.update(bright_at({{20, 15}}));
  std::vector<std::uint32_t> all(f.phd.particles().size());
  std::iota(all.begin(), all.end(), 0U);
  f.phd.remove(all);
  f.phd.resample(f.frame);
  EXPECT_NEAR(f.sum_of_weights(), 0, 1e-6);  // and no NaN
  f.update(empty_frame());
  EXPECT_FALSE(std::isnan(f.phd.expected()));
}

/// After resampling: particles at the left of two pixels, the right one of which shows a target.
struct Left {
  double share = 0, weight = 0;
};
Left left_of_two(ResampleOn resample_on, WeightSum sum = WeightSum::expected_targets) {
  PhdFilterConfig config = config_of(100);
  config.birth_mass = 2;
  config.resample_on = resample_on;
  Filter f(config, sum);
  // A target's peak pixel passes the threshold; the left pixel passes it alone.
  Image<float> image(kSide, kSide);
  const Frame target = image_of(100, {{30, 15}});
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) image.view()(x, y) = target.view()(x, y);
  }
  image.view()(10, 15) = 1.001F;
  f.update(Frame(std::move(image)));
  f.phd.resample(f.frame);
  const Particles& p = f.phd.particles();
  const auto members = members_on(p, true);
  Left left{static_cast<double>(members.size()) / static_cast<double>(p.size())};
  for (const auto i : members) left.weight += p.weight[i];
  return left;
}

// P-PHD (24) leaves out the normaliser, which lets a dim target have as much as its n.
TEST(PhdFilter, ResamplesByWeightOrByLikelihood) {
  const double by_weight = left_of_two(ResampleOn::weight).share;
  const double by_likelihood = left_of_two(ResampleOn::likelihood).share;
  EXPECT_GT(by_weight, 5 * by_likelihood);
  EXPECT_GT(by_likelihood, 0);
}

// The odds of the bright target leave the dim one as many particles as a PHD does; the weights make
// up for it.
TEST(PhdFilter, OfOddsDrawsByExpectedTargets) {
  const Left targets = left_of_two(ResampleOn::weight);
  const Left odds = left_of_two(ResampleOn::weight, WeightSum::odds);
  EXPECT_NEAR(odds.share, targets.share, 1e-6);
  // Its pixel has the odds w, of which the other shows w / (1 + w).
  EXPECT_NEAR(odds.weight, targets.weight / (1 - targets.weight), 0.05 * odds.weight);
}

TEST(PhdFilter, StartsAgainWithAnotherAppearance) {
  Filter f(config_of());
  f.update(bright_at({{20, 15}}));
  f.phd.resample(f.frame);
  f.phd.set_appearance(ready(config_of()));
  EXPECT_EQ(f.phd.size(), 0U);
  EXPECT_EQ(f.phd.expected(), 0);
}

}  // namespace
}  // namespace glint

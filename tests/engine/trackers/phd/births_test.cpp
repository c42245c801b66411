// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/births.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/trackers/phd/births_scene.hpp"

namespace glint {
namespace {

using namespace test;

Frame one_bright_pixel(int x, int y, float value = 5) {
  Image<float> image(kSide, kSide);
  image.view()(x, y) = value;
  return Frame(std::move(image));
}

TEST(UniformBirths, LieAroundThePixelsAboveTheThreshold) {
  Nursery nursery(config_of(BirthProposal::uniform), dim());
  const Particles p = nursery.draw(one_bright_pixel(7, 9));
  ASSERT_EQ(p.size(), kCount);
  const auto [left, right] = std::ranges::minmax(p.x);
  const auto [top, bottom] = std::ranges::minmax(p.y);
  EXPECT_NEAR(left, 5.5, 0.01);
  EXPECT_NEAR(right, 8.5, 0.01);
  EXPECT_NEAR(top, 7.5, 0.01);
  EXPECT_NEAR(bottom, 10.5, 0.01);
  for (const float w : p.weight) ASSERT_FLOAT_EQ(w, kMass / kCount);  // P-PHD (30)
  for (const auto* zero : {&p.ax, &p.ay}) EXPECT_EQ(std::ranges::count(*zero, 0.0F), kCount);
  EXPECT_EQ(std::ranges::count(p.label, 0U), kCount);
}

TEST(UniformBirths, AreNoneWithoutSuchAPixelOrWhereItIsMasked) {
  Nursery nursery(config_of(BirthProposal::uniform), dim());
  EXPECT_EQ(nursery.draw(one_bright_pixel(7, 9, 0.9F)).size(), 0U);
  nursery.mask.set(std::vector<Box>{{7, 9, 8, 10}}, kSide, kSide);
  EXPECT_EQ(nursery.draw(one_bright_pixel(7, 9)).size(), 0U);
  EXPECT_EQ(nursery.draw(one_bright_pixel(8, 9)).size(), kCount);
}

TEST(UniformBirths, FillTheRangesOfVelocityIntensityAndModels) {
  AppearanceConfig appearance = dim();
  appearance.snr_low = 6, appearance.snr_high = 26;
  Nursery nursery(config_of(BirthProposal::uniform), appearance);
  const Particles p = nursery.draw(one_bright_pixel(7, 9));
  for (const auto* v : {&p.vx, &p.vy}) {
    const auto [low, high] = std::ranges::minmax(*v);
    EXPECT_NEAR(low, -kSpeed, 0.01);
    EXPECT_NEAR(high, kSpeed, 0.01);
  }
  // Uniform in decibels: as many below the middle, 16 dB, as above.
  const double middle = narrow_spread().intensity_of_snr(16);
  const auto dimmer = std::ranges::count_if(p.intensity, [&](float i) { return i < middle; });
  EXPECT_NEAR(static_cast<double>(dimmer) / kCount, 0.5, 0.03);
  const auto [dimmest, brightest] = std::ranges::minmax(p.intensity);
  EXPECT_NEAR(dimmest, narrow_spread().intensity_of_snr(6), 0.1);
  EXPECT_NEAR(brightest, narrow_spread().intensity_of_snr(26), 0.5);
  const double share[3] = {0.8, 0.1, 0.1};  // P-PHD section 5.2
  for (std::uint32_t mode = 0; mode < 3; ++mode) {
    EXPECT_NEAR(static_cast<double>(std::ranges::count(p.mode, mode)) / kCount, share[mode], 0.02);
  }
}

// Cells are drawn in proportion to their score s, so the weight is gamma / J mean(s) / s.
TEST(MatchedFilterBirths, AreWeightedAgainstTheirProposal) {
  constexpr double kRatio = 20;
  Nursery nursery(config_of(BirthProposal::matched_filter), exact_appearance(kRatio));
  const Frame z = image_of(kRatio, {{20, 15}});
  const auto scores = scores_of(z.view(), intensity_of_ratio(kRatio));
  const Particles p = nursery.draw(z);
  ASSERT_EQ(p.size(), kCount);
  int at_the_target = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto cell = cell_at(pixel_of(p.x[i]), pixel_of(p.y[i]), kSide);
    ASSERT_NEAR(p.weight[i] / (kMass / kCount * mean_of(scores) / scores[cell]), 1, 1e-3);
    at_the_target += cell == cell_at(20, 15, kSide);
  }
  const double share = scores[cell_at(20, 15, kSide)] / (mean_of(scores) * kSide * kSide);
  EXPECT_NEAR(at_the_target, kCount * share, 2);  // systematic resampling
}

TEST(MatchedFilterBirths, AreNotInTheMask) {
  Nursery nursery(config_of(BirthProposal::matched_filter), dim());
  nursery.mask.set(std::vector<Box>{{0, 0, kSide, 20}}, kSide, kSide);
  for (const float y : nursery.draw(empty_frame()).y) ASSERT_GT(y, 19.49F);
}

}  // namespace
}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/frames/point_spread_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "glint/kernels/core/point_spread.hpp"

namespace glint {
namespace {

constexpr int kSide = 120;

/// Adds a target of this width and peak at the centre of a pixel.
void add_target(Image<float>& image, int x, int y, double sigma, double peak) {
  const PointSpread spread = PointSpread::of(sigma);
  const double intensity = spread.intensity_of_snr(20 * std::log10(peak));
  for (int j = -kMaxHalfWidth; j <= kMaxHalfWidth; ++j) {
    for (int i = -kMaxHalfWidth; i <= kMaxHalfWidth; ++i) {
      image.view()(x + i, y + j) +=
          static_cast<float>(intensity * spread.weight(i, 0) * spread.weight(j, 0));
    }
  }
}

TEST(PointSpreadFit, FindsTheWidthOfTheTargets) {
  for (const double sigma : {0.6, 1.0, 1.9}) {
    Image<float> image(kSide, kSide);
    add_target(image, 30, 40, sigma, 20);
    add_target(image, 80, 70, sigma, 25);
    const auto found = fit_point_spread(image.view(), {});
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR(*found, sigma, 0.051);
  }
}

TEST(PointSpreadFit, TakesTheShapeFromTheRawFrameAboveTheLevelAround) {
  Image<float> whitened(kSide, kSide), raw(kSide, kSide);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) raw.view()(x, y) = 200;
  }
  add_target(whitened, 60, 60, 2.0, 20);
  add_target(raw, 60, 60, 0.8, 60);
  EXPECT_NEAR(fit_point_spread(whitened.view(), raw.view()).value_or(0), 0.8, 0.051);
}

// 24 narrow targets and a wide one that is brighter than all of them.
TEST(PointSpreadFit, GoesByTheBrightestTargets) {
  Image<float> image(kSide, kSide);
  for (int k = 0; k < 24; ++k) add_target(image, 10 + 18 * (k % 6), 10 + 18 * (k / 6), 0.5, 12);
  add_target(image, 60, 105, 1.8, 200);
  EXPECT_NEAR(fit_point_spread(image.view(), {}).value_or(0), 1.8, 0.051);
}

TEST(PointSpreadFit, IsNothingWithoutATargetOfSixSigma) {
  Image<float> image(kSide, kSide);
  EXPECT_FALSE(fit_point_spread(image.view(), {}).has_value());
  image.view()(60, 60) = 5.9F;
  EXPECT_FALSE(fit_point_spread(image.view(), {}).has_value());
  image.view()(60, 60) = 6.1F;
  EXPECT_TRUE(fit_point_spread(image.view(), {}).has_value());
}

}  // namespace
}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/h_pmht/point_evidence.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace glint {
namespace {

constexpr int kSide = 40;
const PointSpread kSpread = PointSpread::of(1);

/// A target of `intensity` at the centre of pixel (20, 15), without noise.
Image<float> frame_with(double intensity) {
  Image<float> image(kSide, kSide);
  for (int j = -3; j <= 3; ++j) {
    for (int i = -3; i <= 3; ++i) {
      image.view()(20 + i, 15 + j) =
          static_cast<float>(intensity * kSpread.weight(i, 0) * kSpread.weight(j, 0));
    }
  }
  return image;
}

double energy() {
  double sum = 0;
  for (int i = -3; i <= 3; ++i) sum += kSpread.weight(i, 0) * kSpread.weight(i, 0);
  return sum * sum;
}

// I A - I^2 B / 2 with A = I B.
TEST(PointEvidence, OfAKnownPlaceIsTheRatioOfItsPixel) {
  const Image<float> image = frame_with(8);
  const double sure = 1e-6 - 1.0 / 12;  // the pixel alone
  const std::array intensity{8.0};
  EXPECT_NEAR(mean_likelihood_ratio(image.view(), kSpread, intensity, {20, 15, sure, sure}),
              std::exp(32 * energy()), 1e-3);
  const std::array two{8.0, 4.0};
  EXPECT_NEAR(mean_likelihood_ratio(image.view(), kSpread, two, {20, 15, sure, sure}),
              (std::exp(32 * energy()) + std::exp(24 * energy())) / 2, 1e-3);
  const Image<float> empty(kSide, kSide);
  EXPECT_NEAR(mean_likelihood_ratio(empty.view(), kSpread, intensity, {20, 15, sure, sure}),
              std::exp(-32 * energy()), 1e-6);
}

TEST(PointEvidence, IsTheMeanOverWhereTheTargetMayBe) {
  const Image<float> image = frame_with(8);
  const std::array intensity{8.0};
  const double near = mean_likelihood_ratio(image.view(), kSpread, intensity, {20, 15, .1, .1});
  const double vague = mean_likelihood_ratio(image.view(), kSpread, intensity, {20, 15, 4, 4});
  const double off = mean_likelihood_ratio(image.view(), kSpread, intensity, {24, 15, .1, .1});
  EXPECT_GT(near, vague);
  EXPECT_GT(vague, 1);
  EXPECT_LT(off, 1);
}

TEST(PointEvidence, OutsideTheFrameIsNone) {
  const Image<float> empty(kSide, kSide);
  const std::array intensity{1e-6};  // every ratio inside is 1
  EXPECT_NEAR(mean_likelihood_ratio(empty.view(), kSpread, intensity, {20, 15, 1, 1}), 1, 1e-6);
  EXPECT_NEAR(mean_likelihood_ratio(empty.view(), kSpread, intensity, {-0.5, 15, 1, 1}), 0.5, 1e-4);
  EXPECT_EQ(mean_likelihood_ratio(empty.view(), kSpread, intensity, {-30, 15, 1, 1}), 0);
}

}  // namespace
}  // namespace glint

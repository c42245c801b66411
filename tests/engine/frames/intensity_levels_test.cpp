// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/frames/intensity_levels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace glint {
namespace {

TEST(IntensityLevels, OfARamp) {
  Image<float> image(50, 40);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 50; ++x) image.view()(x, y) = static_cast<float>(50 * y + x);  // 0 to 1999
  }
  std::vector<float> workspace;
  const IntensityLevels levels = intensity_levels(image.view(), workspace);
  EXPECT_EQ(levels.mean, 999.5);
  EXPECT_EQ(levels.high, 1998);  // one pixel in a thousand lies there or above
}

TEST(IntensityLevels, DisplayTheMeanAndATenthOfTheTopPermille) {
  Image<float> image(100, 20);
  for (int y = 0; y < 20; ++y) std::fill_n(image.view().row(y), 100, 2.0F);
  for (int x = 0; x < 4; ++x) image.view()(x, 3) = 10;
  image.view()(7, 7) = NAN;
  std::vector<float> workspace;
  const double mean = (2.0 * 1995 + 4 * 10) / 1999;
  EXPECT_NEAR(intensity_levels(image.view(), workspace).displayed(), mean + 1, 1e-9);
  image.view()(50, 10) = 1e6F;  // one pixel moves the mean, not the rest
  EXPECT_LT(intensity_levels(image.view(), workspace).displayed(), mean + 1 + 1e6 / 1999);
  EXPECT_EQ(intensity_levels({}, workspace).displayed(), 0);
}

TEST(IntensityLevels, OnePixelInTwoThousandDoesNotSetTheHighLevel) {
  Image<float> image(50, 40);
  for (int y = 0; y < 40; ++y) std::fill_n(image.view().row(y), 50, 10.0F);
  image.view()(7, 7) = 255;
  std::vector<float> workspace;
  const IntensityLevels levels = intensity_levels(image.view(), workspace);
  EXPECT_EQ(levels.high, 10);
  EXPECT_DOUBLE_EQ(levels.displayed(), levels.mean + 1);  // P-HPMHT (23)
}

TEST(IntensityLevels, LeaveOutWhatIsNotFinite) {
  Image<float> image(3, 1);
  image.view()(0, 0) = 4;
  image.view()(1, 0) = std::numeric_limits<float>::quiet_NaN();
  image.view()(2, 0) = std::numeric_limits<float>::infinity();
  std::vector<float> workspace;
  const IntensityLevels levels = intensity_levels(image.view(), workspace);
  EXPECT_EQ(levels.mean, 4);
  EXPECT_EQ(levels.high, 4);
}

TEST(IntensityLevels, AreZeroOfNothing) {
  std::vector<float> workspace{1, 2};
  const IntensityLevels levels = intensity_levels(FrameView{}, workspace);
  EXPECT_EQ(levels.mean, 0);
  EXPECT_EQ(levels.high, 0);
}

TEST(RobustMoments, OfFiveValuesOneOfThemFarOff) {
  std::vector<float> values{100, 2, 4, 3, 1};
  const RobustMoments moments = robust_moments(values);
  EXPECT_EQ(moments.median, 3);
  EXPECT_DOUBLE_EQ(moments.sigma, 1.4826);
}

TEST(RobustMoments, AreZeroOfNothing) {
  std::vector<float> values;
  EXPECT_EQ(robust_moments(values).median, 0);
  EXPECT_EQ(robust_moments(values).sigma, 0);
}

}  // namespace
}  // namespace glint

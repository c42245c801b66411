// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/intensity_levels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "glint/kernels/core/frame.hpp"

namespace glint {
namespace {

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

}  // namespace
}  // namespace glint

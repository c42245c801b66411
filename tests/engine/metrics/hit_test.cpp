// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/metrics/hit.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace glint {
namespace {

/// Pixels 10 and 11 of rows 20 and 21.
Patch patch() { return {{10, 20, 12, 22}, {1, 0.5F, 0.49F, 0}, {0, 0, 0, 0}}; }

TEST(Hit, IsAPixelOfWhichTheTargetCoversHalf) {
  EXPECT_TRUE(hits({10, 20}, patch()));
  EXPECT_TRUE(hits({11, 20}, patch()));
  EXPECT_FALSE(hits({10, 21}, patch()));
  EXPECT_FALSE(hits({11, 21}, patch()));
}

TEST(Hit, IsOfThePixelThatHoldsTheEstimate) {
  EXPECT_TRUE(hits({9.51, 19.51}, patch()));
  EXPECT_TRUE(hits({11.49, 20.49}, patch()));
  EXPECT_FALSE(hits({9.49, 20}, patch()));
  EXPECT_FALSE(hits({11.51, 20}, patch()));
  EXPECT_FALSE(hits({10, 19.49}, patch()));
}

TEST(Hit, IsNoneOutsideOrNowhere) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(hits({-1e300, 20}, patch()));
  EXPECT_FALSE(hits({10, 1e300}, patch()));
  EXPECT_FALSE(hits({kNan, 20}, patch()));
  EXPECT_FALSE(hits({10, kNan}, patch()));
  EXPECT_FALSE(hits({0, 0}, Patch{}));
}

TEST(Hit, FollowsATargetOverTheEdgeOfTheFrame) {
  const Patch at_edge{{-1, -1, 0, 0}, {1}, {0}};
  EXPECT_TRUE(hits({-1, -1}, at_edge));
  EXPECT_FALSE(hits({0, 0}, at_edge));
}

}  // namespace
}  // namespace glint

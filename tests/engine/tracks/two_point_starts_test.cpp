// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/tracks/two_point_starts.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace glint {
namespace {

TEST(TwoPointStarts, TakeTheBrightestThenTheNearestAndEachPointOnce) {
  TwoPointStarts starts;
  const std::vector<FreePoint> before{{{0, 0}, 5}, {{3, 0}, 5}, {{50, 50}, 9}};
  const std::vector<FreePoint> now{{{1, 0}, 5}, {{3.5, 0}, 6}, {{2, 1}, 5}};
  const auto found = starts.find(before, now, 4);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].now.position, now[1].position);  // 11, and nearer to the second
  EXPECT_EQ(found[0].before.position, before[1].position);
  EXPECT_EQ(found[1].now.position, now[0].position);
  EXPECT_EQ(found[1].before.position, before[0].position);
  EXPECT_TRUE(starts.find(before, {}, 4).empty());
}

}  // namespace
}  // namespace glint

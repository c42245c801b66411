// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/pixel_mask.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace glint {
namespace {

TEST(PixelMask, CoversThePixelsOfItsBoxesAndNoOthers) {
  PixelMask mask;
  const std::vector<Box> boxes{{2, 3, 5, 6}, {4, 4, 7, 5}};
  mask.set(boxes, 10, 8);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 10; ++x) {
      const bool inside = boxes[0].contains(x, y) || boxes[1].contains(x, y);
      EXPECT_EQ(mask.covers(static_cast<float>(x), static_cast<float>(y)), inside) << x << ' ' << y;
    }
  }
}

TEST(PixelMask, TakesAPositionForThePixelThatHoldsIt) {
  PixelMask mask;
  mask.set(std::vector<Box>{{2, 3, 3, 4}}, 10, 8);
  EXPECT_TRUE(mask.covers(1.5F, 2.5F));
  EXPECT_TRUE(mask.covers(2.49F, 3.49F));
  EXPECT_FALSE(mask.covers(2.5F, 3));
  EXPECT_FALSE(mask.covers(1.49F, 3));
  EXPECT_FALSE(mask.covers(2, 3.5F));
  EXPECT_FALSE(mask.covers(2, 2.49F));
}

TEST(PixelMask, ClipsItsBoxesToTheFrame) {
  PixelMask mask;
  mask.set(std::vector<Box>{{-4, -4, 1, 1}, {9, 7, 20, 20}, {10, 0, 12, 3}, {3, 3, 3, 6}}, 10, 8);
  EXPECT_EQ(std::vector<Box>(mask.boxes().begin(), mask.boxes().end()),
            (std::vector<Box>{{0, 0, 1, 1}, {9, 7, 10, 8}}));
  EXPECT_TRUE(mask.covers(0, 0));
  EXPECT_TRUE(mask.covers(9.4F, 7.4F));
  EXPECT_FALSE(mask.covers(-1, -1));
  EXPECT_FALSE(mask.covers(9.5F, 7));
  EXPECT_FALSE(mask.covers(std::nanf(""), 3));
}

TEST(PixelMask, ForgetsItsBoxesWithTheNextOnes) {
  PixelMask mask;
  mask.set(std::vector<Box>{{2, 3, 5, 6}}, 10, 8);
  EXPECT_FALSE(mask.empty());
  mask.set(std::vector<Box>{{7, 1, 8, 2}}, 10, 8);
  EXPECT_FALSE(mask.covers(2, 3));
  EXPECT_TRUE(mask.covers(7, 1));
  mask.set(std::vector<Box>{{2, 3, 5, 6}}, 6, 7);  // another size
  EXPECT_TRUE(mask.covers(4, 5));
  EXPECT_FALSE(mask.covers(1, 1));
  mask.set({}, 6, 7);
  EXPECT_TRUE(mask.empty());
  EXPECT_FALSE(mask.covers(4, 5));
}

}  // namespace
}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/frames/sample_times.hpp"

#include <gtest/gtest.h>

namespace glint {
namespace {

TEST(SampleTimes, TakesEveryFrameAtFirstAndThenOneAStride) {
  SampleTimes times(15, 6);
  std::vector<int> due;
  for (int t = 0; t < 400; ++t) {
    if (!times.due(t)) continue;
    EXPECT_LT(times.insert(t), 15);
    due.push_back(t);
  }
  for (int t = 0; t <= 15; ++t) EXPECT_EQ(due[static_cast<std::size_t>(t)], t);
  EXPECT_EQ(due.back() - due[due.size() - 2], 6);
  EXPECT_EQ(times.size(), 15);
  EXPECT_EQ(times.span(), 84);
}

TEST(SampleTimes, KeepsAllOfAYoungStreamInView) {
  SampleTimes times(15, 6);
  for (int t = 0; t <= 60; ++t) {
    if (times.due(t)) times.insert(t);
    EXPECT_GE(times.span(), t - 6) << t;
  }
}

TEST(SampleTimes, AFullWindowLosesTheInnerSampleWhoseNeighboursAreClosest) {
  SampleTimes times(4, 10);
  for (const int t : {0, 5, 6, 7}) times.insert(t);
  EXPECT_EQ(times.insert(20), 2);  // 6, between 5 and 7
  EXPECT_EQ(times.insert(22), 1);  // 5, between 0 and 7
  EXPECT_EQ(times.insert(39), 2);  // 20, between 7 and 22
  EXPECT_EQ(times.insert(40), 0);  // 0, older than the window of 40 frames
}

}  // namespace
}  // namespace glint

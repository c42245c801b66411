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

}  // namespace
}  // namespace glint

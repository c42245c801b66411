// SPDX-License-Identifier: Apache-2.0
#include "glint/bench/together.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace glint::bench {
namespace {

constexpr std::int64_t kFrames = 60;

// Targets within 3 px of a confirmed track at the last frame.
int followed(const MemoryScene& scene, const TrackLog& log) {
  const auto points = log.at(kFrames - 1);
  int count = 0;
  for (int target = 0; target < scene.targets(); ++target) {
    const auto place = scene.place(target, kFrames - 1);
    count += std::ranges::any_of(points, [&](const TrackPoint& p) {
      return p.status == TrackStatus::confirmed && std::hypot(p.x - place.x, p.y - place.y) < 3;
    });
  }
  return count;
}

// A figure of trackers side by side says nothing if one of them has nothing to do.
TEST(Together, BothTrackersFollowTheTargetsOfTheStream) {
  const auto scene = std::make_shared<const MemoryScene>(dim_stream());
  WarmEngine engine(scene, {"mm-phd", "pmht-imm"}, Device::tbb(1));
  engine.advance(kFrames / 2);
  engine.advance(kFrames / 2);
  ASSERT_EQ(engine.scheduler().frames(), kFrames);
  EXPECT_GE(followed(*scene, *engine.scheduler().logs()[0]), 18);
  EXPECT_GE(followed(*scene, *engine.scheduler().logs()[1]), 18);
}

}  // namespace
}  // namespace glint::bench

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/h_pmht/frame_pair_starts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "glint/engine/scenario/scenario.hpp"
#include "glint/kernels/core/random.hpp"

namespace glint {
namespace {

/// Points row by row, each up to half a pixel off its pixel.
std::vector<Point> scatter(std::uint32_t set, std::uint32_t count) {
  std::vector<Point> points;
  const RandomKey key = random_key(11, set, Purpose::scenario);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Words4 words = random_words(key, i);
    points.push_back({uniform(words.w[0]) * 50, uniform(words.w[1]) * 40, uniform(words.w[2]) * 9});
  }
  std::sort(points.begin(), points.end(), [](const Point& a, const Point& b) {
    return std::floor(a.y + 0.5F) < std::floor(b.y + 0.5F);
  });
  return points;
}

TEST(FramePairStarts, AreAllPairsInReachByFallingScore) {
  const std::vector<Point> before = scatter(1, 120), now = scatter(2, 150);
  std::vector<double> expected;
  for (const Point& a : before) {
    for (const Point& b : now) {
      if (std::hypot(a.x - b.x, a.y - b.y) <= 5)
        expected.push_back(double{a.amplitude} + b.amplitude);
    }
  }
  std::sort(expected.rbegin(), expected.rend());
  std::vector<FramePairStart> pairs;
  pair_points(before, now, 5, pairs);
  ASSERT_EQ(pairs.size(), expected.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) EXPECT_EQ(pairs[i].score, expected[i]);
}

TEST(FramePairStarts, PutAMovingTargetFirst) {
  Scene scene;
  scene.width = 60, scene.height = 50, scene.frames = 2;
  scene.point_spread = PointSpread::of(1);
  ScriptedTarget target;
  target.death = 2, target.intensity = 40, target.path = fly({20, 30, 2.5, -1});
  scene.targets.push_back(target);
  FramePairStarts starts(scene.point_spread, 25, -0.5, Device::serial());
  EXPECT_TRUE(starts.find(render(scene, 3, 0).view(), 4).empty());
  const Image<float> second = render(scene, 3, 1);
  const auto pairs = starts.find(second.view(), 4);
  ASSERT_FALSE(pairs.empty());
  EXPECT_NEAR(pairs[0].x, 22.5, 0.7);
  EXPECT_NEAR(pairs[0].y, 29, 0.7);
  EXPECT_NEAR(pairs[0].before_x, 20, 0.7);
  EXPECT_NEAR(pairs[0].before_y, 30, 0.7);
  EXPECT_TRUE(starts.find({}, 4).empty());
  EXPECT_TRUE(starts.find(second.view(), 4).empty());  // nothing before it
}

}  // namespace
}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "glint/engine/scenario/scenes.hpp"

namespace glint {
namespace {

std::vector<Kinematics> course_of(const DimTargetScene& config) {
  const Scene scene = make_scene(config);
  std::vector<Kinematics> frames;
  for (int k = 0; k < 30; ++k) frames.push_back(scene.targets.front().path(k));
  return frames;
}

TEST(DimTarget, IsThereInFramesTenToThirtyNineOfFifty) {
  const Scene scene = make_scene(DimTargetScene{});
  EXPECT_EQ(scene.frames, 50);
  for (int frame = 0; frame < 50; ++frame) {
    EXPECT_EQ(truth_at(scene, frame).size(), frame >= 10 && frame < 40 ? 1U : 0U) << frame;
  }
}

TEST(DimTarget, StaysThreePixelsInsideTheFrame) {
  DimTargetScene config;
  config.size = 48;
  for (config.variant = 0; config.variant < 50; ++config.variant) {
    for (const Kinematics& at : course_of(config)) {
      EXPECT_TRUE(at.x > 3 && at.x < 44 && at.y > 3 && at.y < 44) << config.variant;
    }
  }
}

TEST(DimTarget, KeepsItsSpeedWithoutManoeuvre) {
  DimTargetScene config;
  config.manoeuvre = 0, config.speed = 1.2;
  const auto frames = course_of(config);
  for (std::size_t k = 1; k < frames.size(); ++k) {
    EXPECT_NEAR(std::hypot(frames[k].x - frames[k - 1].x, frames[k].y - frames[k - 1].y), 1.2,
                1e-9);
  }
}

TEST(DimTarget, HasACourseOfItsOwnForEachVariant) {
  DimTargetScene one, other;
  other.variant = 1;
  EXPECT_EQ(course_of(one).front().x, course_of(one).front().x);
  EXPECT_NE(course_of(one).front().x, course_of(other).front().x);
}

// White noise on the acceleration of density q: per frame, velocity changes by variance q, position
// beyond its velocity by q / 3, and both together by q / 2.
TEST(DimTarget, ManoeuvresAsWhiteNoiseOnTheAccelerationSays) {
  DimTargetScene config;
  config.size = 2048, config.speed = 0, config.manoeuvre = 0.25;
  double vv = 0, xx = 0, xv = 0, count = 0;
  for (config.variant = 0; config.variant < 200; ++config.variant) {
    const auto frames = course_of(config);
    for (std::size_t k = 1; k < frames.size(); ++k) {
      const double v = frames[k].vx - frames[k - 1].vx;
      const double x = frames[k].x - frames[k - 1].x - frames[k - 1].vx;
      vv += v * v, xx += x * x, xv += x * v, ++count;
    }
  }
  EXPECT_NEAR(vv / count, 0.25, 0.02);
  EXPECT_NEAR(xx / count, 0.25 / 3, 0.007);
  EXPECT_NEAR(xv / count, 0.25 / 2, 0.01);
}

TEST(DimTarget, ThatNoFrameHoldsIsAnErrorWithTheRemedy) {
  DimTargetScene config;
  config.speed = 50;
  try {
    make_scene(config);
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find("lower them or raise size"), std::string::npos);
  }
}

}  // namespace
}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/frames/frame_preparer.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <set>

#include "frame_preparer_scene.hpp"

namespace glint::test {
namespace {

TEST(FramePreparer, WhitensNoiseToUnitVariance) {
  Scene scene;
  scene.amplitude = 0;
  for (const auto background : {BackgroundKind::temporal, BackgroundKind::registered}) {
    FramesConfig config;
    config.background = background;
    config.structure = false;
    FramePreparer preparer(config, Device::tbb(2));
    const Scan scan = prepare(preparer, scene, 40);
    EXPECT_NEAR(deviation(scan.whitened.view()), 0.97, 0.06) << static_cast<int>(background);
    EXPECT_NEAR(scan.noise_sigma, 2.1, 0.25) << static_cast<int>(background);
  }
}

TEST(FramePreparer, ShowsAMovingTargetFromTheFirstFramesOn) {
  const Scene scene;
  FramesConfig config;
  config.structure = false;
  FramePreparer preparer(config, Device::tbb(1));
  for (int t = 0; t < 30; ++t) {
    const std::vector<float> pixels = scene.at(t);
    const Scan scan = preparer.prepare(raw(pixels), t, t);
    const int x = static_cast<int>(std::lround(scene.target_x(t)));
    EXPECT_EQ(scan.frame, t);
    if (t >= 4) {
      EXPECT_GT(scan.whitened.view()(x, 30), 3) << t;
    }
  }
}

// A target that stands still for the first frames is background until it moves, unless the
// background was learned ahead.
TEST(FramePreparer, LearnsTheBackgroundAhead) {
  const auto z_of_a_waiting_target = [](BackgroundKind background, int learned) {
    FramesConfig config;
    config.structure = false;
    config.background = background;
    FramePreparer preparer(config, Device::tbb(1));
    for (int t = 20; t < 20 + learned; ++t) preparer.learn(raw(Scene{}.at(t)));
    Scan scan;
    for (int t = 0; t < 10; ++t) scan = preparer.prepare(raw(Scene{}.at(5)), t, t);
    return scan.whitened.view()(static_cast<int>(std::lround(Scene{}.target_x(5))), 30);
  };
  for (const auto background : {BackgroundKind::temporal, BackgroundKind::registered}) {
    EXPECT_LT(z_of_a_waiting_target(background, 0), 1) << static_cast<int>(background);
    EXPECT_GT(z_of_a_waiting_target(background, 30), 5) << static_cast<int>(background);
  }
}

TEST(FramePreparer, RefusesToLearnFramesOfAnotherSize) {
  FramePreparer preparer({}, Device::tbb(1));
  const std::vector<float> pixels(64, 1.0F);
  preparer.learn(raw(pixels, 8, 8));
  EXPECT_THROW(preparer.learn(raw(pixels, 16, 4)), std::invalid_argument);
  EXPECT_THROW(preparer.prepare(raw(pixels, 16, 4), 0, 0), std::invalid_argument);
}

TEST(FramePreparer, AStaticSceneLeavesNothing) {
  Scene scene;
  scene.amplitude = 0, scene.noise = 0;
  FramePreparer preparer({}, Device::tbb(1));
  const Scan scan = prepare(preparer, scene, 3);
  EXPECT_EQ(deviation(scan.whitened.view()), 0);
}

TEST(FramePreparer, OneFrameOrAConstantOneOfAnySizeIsDefined) {
  for (const auto background : {BackgroundKind::temporal, BackgroundKind::registered,
                                BackgroundKind::spatial, BackgroundKind::none}) {
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 40}, {3, 2}, {7, 7}, {65, 33}}) {
      FramesConfig config;
      config.background = background;
      FramePreparer preparer(config, Device::tbb(1));
      for (const float value : {0.0F, 0.0F, 5.0F}) {
        const std::vector<float> pixels(static_cast<std::size_t>(width * height), value);
        const Scan scan = preparer.prepare(raw(pixels, width, height), 0, 0);
        EXPECT_TRUE(all_finite(scan.whitened.view())) << static_cast<int>(background) << width;
        EXPECT_TRUE(std::isfinite(scan.noise_sigma));
        EXPECT_GT(scan.noise_sigma, 0);
      }
    }
  }
}

TEST(FramePreparer, EarlierScansStayAsTheyWere) {
  const Scene scene;
  FramePreparer preparer({}, Device::tbb(2));
  const Scan first = prepare(preparer, scene, 5);
  const float raw_value = first.raw.view()(20, 30), z = first.whitened.view()(20, 30);
  for (int t = 5; t < 15; ++t) {
    const std::vector<float> pixels = scene.at(t);
    preparer.prepare(raw(pixels), t, t);
  }
  EXPECT_EQ(first.raw.view()(20, 30), raw_value);
  EXPECT_EQ(first.whitened.view()(20, 30), z);
}

TEST(FramePreparer, ReusesFramesThatNobodyHolds) {
  FramePreparer preparer({}, Device::tbb(1));
  std::set<const float*> seen;
  for (int t = 0; t < 20; ++t) {
    const std::vector<float> pixels = Scene{}.at(t);
    const Scan scan = preparer.prepare(raw(pixels), t, t);
    seen.insert(scan.raw.view().data);
    seen.insert(scan.whitened.view().data);
  }
  EXPECT_EQ(seen.size(), 2u);
}

TEST(FramePreparer, GivesTheSameBitsOnAnyNumberOfThreads) {
  const tbb::global_control eight(tbb::global_control::max_allowed_parallelism, 8);
  for (const auto background : {BackgroundKind::temporal, BackgroundKind::registered}) {
    FramesConfig config;
    config.background = background;
    std::vector<Scan> scans;
    for (const int threads : {1, 2, 3, 8}) {
      FramePreparer preparer(config, Device::tbb(threads));
      Scene scene;
      scene.pan = 0.7;
      scans.push_back(prepare(preparer, scene, 9));
    }
    for (int y = 0; y < kHeight; ++y) {
      for (std::size_t i = 1; i < scans.size(); ++i) {
        const float* a = scans[0].whitened.view().row(y);
        ASSERT_TRUE(std::equal(a, a + kWidth, scans[i].whitened.view().row(y)))
            << static_cast<int>(background);
      }
    }
  }
}

TEST(FramePreparer, RegistrationFollowsAMovingCamera) {
  Scene scene;
  scene.pan = 0.8, scene.amplitude = 0;
  FramesConfig config;
  config.registered_frames = 11;
  config.structure = false;
  FramePreparer still(config, Device::tbb(2));
  config.background = BackgroundKind::registered;
  FramePreparer moving(config, Device::tbb(2));
  const double without = prepare(still, scene, 20).noise_sigma;
  const double with = prepare(moving, scene, 20).noise_sigma;
  EXPECT_LT(with, 0.6 * without);
}

TEST(FramePreparer, DarkTargetsComeOutPositive) {
  Scene scene;
  scene.amplitude = -20;
  for (const auto polarity : {Polarity::dark, Polarity::both}) {
    FramesConfig config;
    config.polarity = polarity;
    config.structure = false;
    FramePreparer preparer(config, Device::tbb(1));
    const Scan scan = prepare(preparer, scene, 20);
    const int x = static_cast<int>(std::lround(scene.target_x(19)));
    EXPECT_GT(scan.whitened.view()(x, 30), 3) << static_cast<int>(polarity);
  }
}

TEST(FramePreparer, EightBitColourFramesHaveTheFloorOfFourLevels) {
  const std::vector<std::uint8_t> pixels(20 * 20 * 3, 90);
  FramePreparer preparer({}, Device::tbb(1));
  const RawPixels colour{pixels.data(), 20, 20, 3, 60};
  preparer.prepare(colour, 0, 0);
  EXPECT_NEAR(preparer.prepare(colour, 1, 1).noise_sigma, 4, 1e-6);
  ASSERT_EQ(preparer.notes().size(), 2u);
  EXPECT_NE(preparer.notes()[0].find("noise sigma 4 "), std::string::npos);
}

}  // namespace
}  // namespace glint::test

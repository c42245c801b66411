// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/frame_preparer.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include "glint/kernels/core/random.hpp"

namespace glint {
namespace {

constexpr int kWidth = 96, kHeight = 80;

/// A scene with an edge, white noise and a bright Gaussian target that moves 1.5 px a frame.
struct Scene {
  int width = kWidth, height = kHeight;
  float noise = 2, amplitude = 20;
  double pan = 0;  ///< movement of everything but the target [px/frame]

  double target_x(int frame) const { return 12 + 1.5 * frame; }
  std::vector<float> at(int frame) const {
    std::vector<float> pixels;
    const RandomKey key = random_key(7, static_cast<std::uint64_t>(frame), Purpose::trial);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const auto item = static_cast<std::uint32_t>(y * width + x);
        const double u = x + pan * frame;
        const double ground = 15 * std::sin(0.5 * u) * std::cos(0.4 * y) + (y > 60 ? 40 : 0);
        const double dx = x - target_x(frame), dy = y - 30;
        const double target = amplitude * std::exp(-(dx * dx + dy * dy) / 2);
        pixels.push_back(static_cast<float>(100 + ground + target) +
                         noise * random_normals(key, item).n[0]);
      }
    }
    return pixels;
  }
};

RawPixels raw(const std::vector<float>& pixels, int width = kWidth, int height = kHeight) {
  return {pixels.data(), width, height, 1, width};
}

/// Prepares frames 0 .. n - 1 and returns the last Scan.
Scan prepare(
    FramePreparer& preparer, const Scene& scene, int n,
    const std::function<void(std::vector<float>&)>& change = [](auto&) {}) {
  Scan scan;
  for (int t = 0; t < n; ++t) {
    std::vector<float> pixels = scene.at(t);
    change(pixels);
    scan = preparer.prepare(raw(pixels, scene.width, scene.height), t, t / 30.0);
  }
  return scan;
}

bool all_finite(FrameView image) {
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (!std::isfinite(image(x, y))) return false;
    }
  }
  return true;
}

double deviation(FrameView z) {
  double sum = 0;
  for (int y = 0; y < z.height; ++y) {
    for (int x = 0; x < z.width; ++x) sum += static_cast<double>(z(x, y)) * z(x, y);
  }
  return std::sqrt(sum / (z.width * z.height));
}

TEST(FramePreparer, WhitensNoiseToUnitVariance) {
  Scene scene;
  scene.amplitude = 0;
  for (const auto* background : {"temporal", "registered"}) {
    FramesConfig config;
    config.background = background;
    config.structure = false;
    FramePreparer preparer(config, Device::tbb(2));
    const Scan scan = prepare(preparer, scene, 40);
    EXPECT_NEAR(deviation(scan.whitened.view()), 0.97, 0.06) << background;
    EXPECT_NEAR(scan.noise_sigma, 2.1, 0.25) << background;
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

TEST(FramePreparer, AStaticSceneLeavesNothing) {
  Scene scene;
  scene.amplitude = 0, scene.noise = 0;
  FramePreparer preparer({}, Device::tbb(1));
  const Scan scan = prepare(preparer, scene, 3);
  EXPECT_EQ(deviation(scan.whitened.view()), 0);
}

TEST(FramePreparer, OneFrameOrAConstantOneOfAnySizeIsDefined) {
  for (const auto* background : {"temporal", "registered", "spatial", "none"}) {
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 40}, {3, 2}, {7, 7}, {65, 33}}) {
      FramesConfig config;
      config.background = background;
      FramePreparer preparer(config, Device::tbb(1));
      for (const float value : {0.0F, 0.0F, 5.0F}) {
        const std::vector<float> pixels(static_cast<std::size_t>(width * height), value);
        const Scan scan = preparer.prepare(raw(pixels, width, height), 0, 0);
        EXPECT_TRUE(all_finite(scan.whitened.view())) << background << width;
        EXPECT_TRUE(std::isfinite(scan.noise_sigma));
        EXPECT_GT(scan.noise_sigma, 0);
      }
    }
  }
}

TEST(FramePreparer, MasksPixelsThatAreNoNumbers) {
  const Scene scene;
  for (const auto* background : {"temporal", "registered", "spatial", "none"}) {
    FramesConfig config;
    config.background = background;
    FramePreparer preparer(config, Device::tbb(1));
    const Scan scan = prepare(preparer, scene, 10, [](std::vector<float>& pixels) {
      pixels[5 * kWidth + 50] = std::numeric_limits<float>::quiet_NaN();
      pixels[6 * kWidth + 50] = -std::numeric_limits<float>::infinity();
    });
    EXPECT_EQ(scan.whitened.view()(50, 5), 0);
    EXPECT_EQ(scan.whitened.view()(50, 6), 0);
    EXPECT_TRUE(all_finite(scan.whitened.view()));
    EXPECT_TRUE(all_finite(scan.raw.view())) << "raw shows the background there";
  }
}

TEST(FramePreparer, AFrameOfNothingButNanIsMaskedAndForgotten) {
  const Scene scene;
  FramePreparer preparer({}, Device::tbb(1));
  prepare(preparer, scene, 8);
  const std::vector<float> nothing(kWidth * kHeight, std::numeric_limits<float>::quiet_NaN());
  const Scan blind = preparer.prepare(raw(nothing), 8, 8);
  EXPECT_EQ(deviation(blind.whitened.view()), 0);
  const std::vector<float> pixels = scene.at(9);
  EXPECT_TRUE(all_finite(preparer.prepare(raw(pixels), 9, 9).whitened.view()));
}

TEST(FramePreparer, IgnoresWhatTheMaskCovers) {
  Image<std::uint8_t> mask(kWidth, kHeight);
  for (int y = 20; y < 40; ++y) std::fill_n(mask.view().row(y), kWidth, 1);
  FramePreparer preparer({}, Device::tbb(1));
  preparer.set_mask(mask);
  const Scan scan = prepare(preparer, {}, 10);
  for (int x = 0; x < kWidth; ++x) EXPECT_EQ(scan.whitened.view()(x, 30), 0);
  EXPECT_GT(deviation(scan.whitened.view()), 0.1);
  EXPECT_TRUE(all_finite(scan.whitened.view()));
}

TEST(FramePreparer, AMaskOfAnotherSizeIsRefused) {
  FramePreparer preparer({}, Device::tbb(1));
  preparer.set_mask(Image<std::uint8_t>(3, 3));
  EXPECT_THROW(prepare(preparer, {}, 1), std::invalid_argument);
}

TEST(FramePreparer, AMaskSetInMidStreamCountsAtOnce) {
  FramePreparer preparer({}, Device::tbb(1));
  prepare(preparer, {}, 3);
  Image<std::uint8_t> mask(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) std::fill_n(mask.view().row(y), kWidth, 1);
  preparer.set_mask(mask);
  const std::vector<float> pixels = Scene{}.at(3);
  EXPECT_EQ(deviation(preparer.prepare(raw(pixels), 3, 3).whitened.view()), 0);
  preparer.set_mask({});
  EXPECT_GT(deviation(preparer.prepare(raw(pixels), 4, 4).whitened.view()), 0.1);
}

TEST(FramePreparer, RefusesFramesThatAreUnlikeTheFirst) {
  const std::vector<float> pixels(400, 1);
  const std::vector<std::uint8_t> bytes(400, 1);
  FramePreparer preparer({}, Device::tbb(1));
  EXPECT_THROW(preparer.prepare(raw(pixels, 0, 5), 0, 0), std::invalid_argument);
  EXPECT_THROW(preparer.prepare({pixels.data(), 10, 10, 2, 20}, 0, 0), std::invalid_argument);
  preparer.prepare(raw(pixels, 20, 20), 0, 0);
  EXPECT_THROW(preparer.prepare(raw(pixels, 20, 19), 1, 0), std::invalid_argument);
  EXPECT_THROW(preparer.prepare({bytes.data(), 20, 20, 1, 20}, 1, 0), std::invalid_argument);
  EXPECT_NO_THROW(preparer.prepare(raw(pixels, 20, 20), 1, 0));
}

TEST(FramePreparer, RefusesARingWithoutPixels) {
  FramesConfig config;
  config.ring_inner = 31;
  EXPECT_THROW(FramePreparer(config, Device::tbb(1)), ConfigError);
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
  for (const auto* background : {"temporal", "registered"}) {
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
        ASSERT_TRUE(std::equal(a, a + kWidth, scans[i].whitened.view().row(y))) << background;
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
  config.background = "registered";
  FramePreparer moving(config, Device::tbb(2));
  const double without = prepare(still, scene, 20).noise_sigma;
  const double with = prepare(moving, scene, 20).noise_sigma;
  EXPECT_LT(with, 0.6 * without);
}

TEST(FramePreparer, DarkTargetsComeOutPositive) {
  Scene scene;
  scene.amplitude = -20;
  for (const auto* polarity : {"dark", "both"}) {
    FramesConfig config;
    config.polarity = polarity;
    config.structure = false;
    FramePreparer preparer(config, Device::tbb(1));
    const Scan scan = prepare(preparer, scene, 20);
    const int x = static_cast<int>(std::lround(scene.target_x(19)));
    EXPECT_GT(scan.whitened.view()(x, 30), 3) << polarity;
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
}  // namespace glint

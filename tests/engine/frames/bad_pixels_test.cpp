// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/frames/frame_preparer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "frame_preparer_scene.hpp"
#include "glint/kernels/core/cells.hpp"

namespace glint::test {
namespace {

TEST(BadPixels, MasksPixelsThatAreNoNumbers) {
  const Scene scene;
  for (const auto background : {BackgroundKind::temporal, BackgroundKind::registered,
                                BackgroundKind::spatial, BackgroundKind::none}) {
    FramesConfig config;
    config.background = background;
    FramePreparer preparer(config, Device::tbb(1));
    const Scan scan = prepare(preparer, scene, 10, [](std::vector<float>& pixels) {
      pixels[5 * kWidth + 50] = std::numeric_limits<float>::quiet_NaN();
      pixels[6 * kWidth + 50] = -std::numeric_limits<float>::infinity();
      pixels[7 * kWidth + 50] = std::numeric_limits<float>::max();
    });
    for (int y = 5; y < 8; ++y) EXPECT_EQ(scan.whitened.view()(50, y), 0);
    EXPECT_TRUE(std::isfinite(scan.noise_sigma));
    EXPECT_TRUE(all_finite(scan.whitened.view()));
    EXPECT_TRUE(all_finite(scan.raw.view())) << "raw shows the background there";
  }
}

TEST(BadPixels, TheLargestPixelsHaveAFiniteSigma) {
  std::vector<float> pixels(kWidth * kHeight);
  for (const auto background : {BackgroundKind::temporal, BackgroundKind::registered,
                                BackgroundKind::spatial, BackgroundKind::none}) {
    FramesConfig config;
    config.background = background;
    FramePreparer preparer(config, Device::tbb(1));
    for (std::size_t frame = 0; frame < 3; ++frame) {
      for (std::size_t i = 0; i < pixels.size(); ++i) {
        pixels[i] = (i * (frame + 7)) % 3 == 0 ? ToGrey::kLargest : -ToGrey::kLargest;
      }
      const auto time = static_cast<double>(frame);
      const Scan scan = preparer.prepare(raw(pixels), static_cast<std::int64_t>(frame), time);
      EXPECT_TRUE(std::isfinite(scan.noise_sigma))
          << static_cast<int>(background) << ", frame " << frame;
      EXPECT_TRUE(all_finite(scan.whitened.view()))
          << static_cast<int>(background) << ", frame " << frame;
    }
  }
}

TEST(BadPixels, RefusesFramesWithMorePixelsASideThanCellsCanCount) {
  const std::vector<std::uint8_t> pixels(kMaxSide + 1);
  RawPixels wide{pixels.data(), kMaxSide + 1, 1, 1, kMaxSide + 1};
  EXPECT_THROW(FramePreparer({}, Device::tbb(1)).prepare(wide, 0, 0), std::invalid_argument);
  wide.width = kMaxSide;
  EXPECT_NO_THROW(FramePreparer({}, Device::tbb(1)).prepare(wide, 0, 0));
  const RawPixels tall{pixels.data(), 1, kMaxSide + 1, 1, 1};
  EXPECT_THROW(FramePreparer({}, Device::tbb(1)).prepare(tall, 0, 0), std::invalid_argument);
}

TEST(BadPixels, AFrameOfNothingButNanIsMaskedAndForgotten) {
  const Scene scene;
  FramePreparer preparer({}, Device::tbb(1));
  prepare(preparer, scene, 8);
  const std::vector<float> nothing(kWidth * kHeight, std::numeric_limits<float>::quiet_NaN());
  const Scan blind = preparer.prepare(raw(nothing), 8, 8);
  EXPECT_EQ(deviation(blind.whitened.view()), 0);
  const std::vector<float> pixels = scene.at(9);
  EXPECT_TRUE(all_finite(preparer.prepare(raw(pixels), 9, 9).whitened.view()));
}

TEST(BadPixels, IgnoresWhatTheMaskCovers) {
  Image<std::uint8_t> mask(kWidth, kHeight);
  for (int y = 20; y < 40; ++y) std::fill_n(mask.view().row(y), kWidth, 1);
  FramePreparer preparer({}, Device::tbb(1));
  preparer.set_mask(mask);
  const Scan scan = prepare(preparer, {}, 10);
  for (int x = 0; x < kWidth; ++x) EXPECT_EQ(scan.whitened.view()(x, 30), 0);
  EXPECT_GT(deviation(scan.whitened.view()), 0.1);
  EXPECT_TRUE(all_finite(scan.whitened.view()));
}

TEST(BadPixels, AMaskOfAnotherSizeIsRefused) {
  FramePreparer preparer({}, Device::tbb(1));
  preparer.set_mask(Image<std::uint8_t>(3, 3));
  EXPECT_THROW(prepare(preparer, {}, 1), std::invalid_argument);
}

TEST(BadPixels, AMaskSetInMidStreamCountsAtOnce) {
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

TEST(BadPixels, RefusesFramesThatAreUnlikeTheFirst) {
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

TEST(BadPixels, RefusesARingWithoutPixels) {
  FramesConfig config;
  config.ring_inner = 31;
  EXPECT_THROW(FramePreparer(config, Device::tbb(1)), ConfigError);
}

}  // namespace
}  // namespace glint::test

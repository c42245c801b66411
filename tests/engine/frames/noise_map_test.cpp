// SPDX-License-Identifier: Apache-2.0
// What frame_preparer.hpp divides by: the noise sigma of each pixel, in closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "frame_preparer_scene.hpp"

namespace glint::test {
namespace {

constexpr int kSide = 80;
using Pixels = std::vector<float>;

/// Neither structure nor ring, a sigma of 1.
FramesConfig plain() {
  FramesConfig c;
  c.structure = c.ring = false;
  c.sigma_floor = 1;
  return c;
}

Scan next(FramePreparer& preparer, const Pixels& pixels) {
  return preparer.prepare(raw(pixels, kSide, kSide), 0, 0);
}

TEST(NoiseMap, HasTheFloorOfTheSettingsAndItsMeanInTheNotes) {
  FramesConfig config = plain();
  config.sigma_floor = 2.5;
  FramePreparer preparer(config, Device::serial());
  Pixels pixels(kSide * kSide, 100);
  EXPECT_NEAR(next(preparer, pixels).noise_sigma, 2.5, 1e-6);
  pixels[40 * kSide + 40] = 105;
  EXPECT_NEAR(next(preparer, pixels).whitened.view()(40, 40), 5 / 2.5, 1e-6);
  // A frame whose residuals are 10 and -10: their median deviation from 0, in sigmas.
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = i % 2 == 0 ? 90.0F : 110.0F;
  EXPECT_NEAR(next(preparer, pixels).noise_sigma, 14.826, 1e-3);
  EXPECT_NE(preparer.notes()[0].find("noise sigma 6.61 "), std::string::npos)  // of the three
      << preparer.notes()[0];
}

/// A target of 5 grey levels at (40, 40), whose z is 5 / S; a bright square is `away` px beside it.
double z_beside_a_square(int away, bool ring) {
  FramesConfig config = plain();
  config.ring = ring;
  FramePreparer preparer(config, Device::serial());
  Pixels pixels(kSide * kSide, 100);
  next(preparer, pixels);
  pixels[40 * kSide + 40] += 5;
  for (int y = 38; y <= 42; ++y) std::fill_n(pixels.begin() + y * kSide + 38 + away, 5, 130.0F);
  return next(preparer, pixels).whitened.view()(40, 40);
}

// The ring is 31 px wide without its 11 px in the middle, and residuals count at most 10 sigma:
// S = 10 sqrt(25 / (31^2 - 11^2)).
TEST(NoiseMap, RisesByTheResidualsInTheRing) {
  const double s = 10 * std::sqrt(25.0 / (31 * 31 - 11 * 11));
  EXPECT_NEAR(z_beside_a_square(10, true), 5 / s, 1e-3);
  EXPECT_NEAR(z_beside_a_square(20, true), 5, 1e-3);  // beyond the ring
  EXPECT_NEAR(z_beside_a_square(10, false), 5, 1e-3);
}

// A slope of 3 levels a pixel changes by 6 over 3x3 pixels: S is half of that, and all of it while
// the only background is that of the frame itself.
TEST(NoiseMap, RisesByTheBackgroundsGradient) {
  FramesConfig config = plain();
  config.structure = true;
  FramePreparer preparer(config, Device::serial());
  Pixels pixels;
  for (int i = 0; i < kSide * kSide; ++i) pixels.push_back(3.0F * static_cast<float>(i % kSide));
  EXPECT_NEAR(next(preparer, pixels).noise_sigma, 6, 1e-5);
  EXPECT_NEAR(next(preparer, pixels).noise_sigma, 3, 1e-5);
}

TEST(NoiseMap, APixelWithoutAValueShowsTheBackground) {
  FramePreparer preparer(plain(), Device::serial());
  Pixels pixels(kSide * kSide, 100);
  next(preparer, pixels);
  pixels[40 * kSide + 40] = std::numeric_limits<float>::quiet_NaN();
  const Scan scan = next(preparer, pixels);
  EXPECT_EQ(scan.raw.view()(40, 40), 100);
  EXPECT_EQ(scan.whitened.view()(40, 40), 0);
}

}  // namespace
}  // namespace glint::test

// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/pixel_likelihood/pixel_likelihood.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "glint/kernels/core/device.hpp"
#include "glint/kernels/core/random.hpp"
#include "kernels/special_floats.hpp"

namespace glint {
namespace {

Image<float> map_of(FrameView frame, double sigma, float intensity,
                    const Device& device = Device::tbb(2)) {
  Image<float> map(frame.width, frame.height);
  device.run<PixelLikelihood>({.frame = frame,
                               .spread = PointSpread::of(sigma),
                               .intensity = intensity,
                               .map = map.view()});
  return map;
}

struct Moments {
  double a = 0, b = 0;
};

/// A = sum of w z and B = sum of w^2 over the pixels that the frame has: two-dimensional weights,
/// each from its own error functions.
Moments moments(FrameView frame, const PointSpread& spread, int x, int y) {
  Moments m;
  const int half = spread.half_width;
  const double scale = 1 / (std::sqrt(2.0) * spread.sigma);
  const auto share = [&](int k) {
    return (std::erf((k + 0.5) * scale) - std::erf((k - 0.5) * scale)) / 2;
  };
  for (int v = std::max(0, y - half); v <= std::min(frame.height - 1, y + half); ++v) {
    for (int u = std::max(0, x - half); u <= std::min(frame.width - 1, x + half); ++u) {
      const double w = share(u - x) * share(v - y);
      m.a += w * static_cast<double>(frame(u, v));
      m.b += w * w;
    }
  }
  return m;
}

TEST(PixelLikelihood, IsIntensityTimesCorrelationMinusHalfItsSquareTimesEnergy) {
  for (const double sigma : {0.3, 0.6, 0.7, 1.0, 1.7}) {
    const Image<float> frame = noise_frame(37, 11);
    const PointSpread spread = PointSpread::of(sigma);
    for (const Device& device : {Device::serial(), Device::tbb(1)}) {
      const Image<float> map = map_of(frame, sigma, 6, device);
      for (int y = 0; y < 11; ++y) {
        for (int x = 0; x < 37; ++x) {
          const auto [a, b] = moments(frame, spread, x, y);
          ASSERT_NEAR(map.view()(x, y), 6 * a - 18 * b, 2e-5)
              << "sigma " << sigma << " at " << x << ", " << y << " on " << device.description();
        }
      }
    }
  }
}

TEST(PixelLikelihood, SeesTheWholeTargetThroughAWideWindow) {
  Image<float> frame(64, 48);
  for (int y = 0; y < 48; ++y) std::fill_n(frame.view().row(y), 64, 1.0f);
  const Image<float> bright = map_of(frame, 1.0, 1), dark = map_of(Image<float>(64, 48), 1.0, 1);
  // The weights of +-3.5 sigma sum to erf(3.5 / sqrt 2)^2.
  EXPECT_NEAR(bright.view()(30, 20) - dark.view()(30, 20),
              std::pow(std::erf(3.5 / std::sqrt(2)), 2), 1e-6);
  EXPECT_LT(bright.view()(0, 0) - dark.view()(0, 0), 0.5)
      << "a corner has a quarter of it and more";
}

TEST(PixelLikelihood, MovesWithTheFrame) {
  const Image<float> frame = noise_frame(80, 70);
  const FrameView all = frame.view();
  const FrameView part{all.data + 9 * all.pitch + 5, 60, 50, all.pitch};
  const Image<float> whole = map_of(all, 1.0, 9), moved = map_of(part, 1.0, 9);
  for (int y = 3; y < 47; ++y) {
    for (int x = 3; x < 57; ++x) {
      ASSERT_EQ(moved.view()(x, y), whole.view()(x + 5, y + 9)) << x << ", " << y;
    }
  }
}

TEST(PixelLikelihood, IsQuadraticInTheIntensity) {
  const Image<float> frame = noise_frame(40, 30);
  const Image<float> one = map_of(frame, 0.7, 1), two = map_of(frame, 0.7, 2),
                     three = map_of(frame, 0.7, 3);
  for (int x = 0; x < 40; ++x) {
    // Third difference of a quadratic that is 0 at 0.
    EXPECT_NEAR(three.view()(x, 7) - 3 * two.view()(x, 7) + 3 * one.view()(x, 7), 0, 1e-5);
  }
}

TEST(PixelLikelihood, HitsAreTheMapAboveTheThresholdRowByRow) {
  for (const float threshold : {-1e9f, -8.0f, -3.0f, 0.5f, 2.0f, 1e9f}) {
    const Image<float> frame = noise_frame(211, 150);
    Image<float> map(211, 150);
    std::vector<Hit> hits{{1, 2, 3}}, alone;
    PixelLikelihood::Args args{.frame = frame.view(),
                               .spread = PointSpread::of(0.7),
                               .intensity = 5,
                               .threshold = threshold,
                               .map = map.view(),
                               .hits = &hits};
    Device::tbb(2).run<PixelLikelihood>(args);
    args.map = {}, args.hits = &alone;
    Device::tbb(2).run<PixelLikelihood>(args);
    std::vector<Hit> want;
    for (int y = 0; y < 150; ++y) {
      for (int x = 0; x < 211; ++x) {
        if (map.view()(x, y) > threshold) want.push_back({x, y, map.view()(x, y)});
      }
    }
    EXPECT_EQ(hits, want) << "threshold " << threshold;
    EXPECT_EQ(alone, want) << "without a map, threshold " << threshold;
  }
}

TEST(PixelLikelihood, KeepsItsHitMemoryOnceWarm) {
  const Image<float> frame = noise_frame(300, 200);
  std::vector<Hit> hits;
  const PixelLikelihood::Args args{.frame = frame.view(),
                                   .spread = PointSpread::of(0.7),
                                   .intensity = 5,
                                   .threshold = 1,
                                   .hits = &hits};
  Device::tbb(2).run<PixelLikelihood>(args);
  ASSERT_FALSE(hits.empty());
  const Hit* memory = hits.data();
  for (int i = 0; i < 5; ++i) Device::tbb(2).run<PixelLikelihood>(args);
  EXPECT_EQ(hits.data(), memory);
}

TEST(PixelLikelihood, RawWordsAreTheWhitenedFrame) {
  Image<std::uint16_t> raw(75, 20);
  Image<float> white(75, 20);
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 75; ++x) {
      raw.view()(x, y) = static_cast<std::uint16_t>(65000 + (x * 37 + y * 61) % 535);
      white.view()(x, y) = (static_cast<float>(raw.view()(x, y)) - 65200.5f) * 0.02f;
    }
  }
  Image<float> map(75, 20);
  Device::tbb(1).run<PixelLikelihood>({.frame = ImageView<const std::uint16_t>(raw.view()),
                                       .offset = 65200.5f,
                                       .scale = 0.02f,
                                       .spread = PointSpread::of(0.7),
                                       .intensity = 10,
                                       .map = map.view()});
  const Image<float> want = map_of(white, 0.7, 10);
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 75; ++x) ASSERT_NEAR(map.view()(x, y), want.view()(x, y), 2e-4);
  }
}

TEST(PixelLikelihood, StreamedStoresChangeNothing) {
  const int width = 4100, height = 2200;  // a map beyond any last cache's share
  const Image<float> frame = noise_frame(width, height);
  const Image<float> streamed = map_of(frame, 0.7, 8);
  Image<float> shifted(width + 1, height);
  const ImageView<float> unaligned{shifted.view().data + 1, width, height, shifted.view().pitch};
  Device::tbb(2).run<PixelLikelihood>(
      {.frame = frame.view(), .spread = PointSpread::of(0.7), .intensity = 8, .map = unaligned});
  for (int y = 0; y < height; ++y) {
    ASSERT_TRUE(std::equal(unaligned.row(y), unaligned.row(y) + width, streamed.view().row(y)))
        << "row " << y;
  }
}

TEST(PixelLikelihood, RefusesAMapOfAnotherSizeAndAWindowThatIsTooWide) {
  const Image<float> frame(8, 8);
  Image<float> map(8, 9);
  for (const Device& device : {Device::serial(), Device::tbb(1)}) {
    EXPECT_THROW(device.run<PixelLikelihood>({.frame = frame.view(), .map = map.view()}),
                 std::invalid_argument);
    EXPECT_THROW(device.run<PixelLikelihood>(
                     {.frame = frame.view(), .spread = {.sigma = 3, .half_width = 8}}),
                 std::invalid_argument);
  }
}

}  // namespace
}  // namespace glint

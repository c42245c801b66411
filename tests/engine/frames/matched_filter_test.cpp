// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/frames/matched_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "glint/kernels/core/random.hpp"

namespace glint {
namespace {

TEST(MatchedFilter, UnitNoiseStaysUnitNoiseToTheBorder) {
  constexpr int kSize = 24, kFrames = 400;
  MatchedFilter filter(1.0, Device::serial());
  double inside = 0, border = 0;
  for (int f = 0; f < kFrames; ++f) {
    Image<float> noise(kSize, kSize);
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const auto item = static_cast<std::uint32_t>(y * kSize + x);
        noise.view()(x, y) =
            random_normals(random_key(1, static_cast<std::uint64_t>(f), Purpose::trial), item).n[0];
      }
    }
    const FrameView response = filter.response(noise.view());
    inside += std::pow(response(12, 12), 2);
    border += std::pow(response(0, 23), 2);
  }
  const double allowed = 4 * std::sqrt(2.0 / kFrames);
  EXPECT_NEAR(inside / kFrames, 1, allowed);
  EXPECT_NEAR(border / kFrames, 1, allowed);
}

/// The filter's definition at a pixel, in double.
double response_at(FrameView frame, const PointSpread& spread, int x, int y) {
  double product = 0, energy = 0;
  for (int l = -spread.half_width; l <= spread.half_width; ++l) {
    for (int k = -spread.half_width; k <= spread.half_width; ++k) {
      if (!frame.contains(x + k, y + l)) continue;
      const double h = spread.weight(k, 0) * spread.weight(l, 0);
      product += h * static_cast<double>(frame(x + k, y + l));
      energy += h * h;
    }
  }
  return product / std::sqrt(energy);
}

// Frames narrower than the filter, and of more rows than a tile.
TEST(MatchedFilter, IsItsDefinitionAtEverySize) {
  for (const auto& [width, height] : {std::pair{1, 1}, {5, 3}, {6, 7}, {7, 130}, {33, 65}}) {
    Image<float> frame(width, height);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const auto item = static_cast<std::uint32_t>(y * width + x);
        frame.view()(x, y) = random_normals(random_key(2, 0, Purpose::trial), item).n[0];
      }
    }
    MatchedFilter filter(1.0, Device::tbb(2));
    const FrameView response = filter.response(frame.view());
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        ASSERT_NEAR(response(x, y), response_at(frame.view(), PointSpread::of(1.0), x, y), 1e-5)
            << width << 'x' << height << " at " << x << ", " << y;
      }
    }
  }
}

TEST(MatchedFilter, PeaksAtATargetWithItsDeflection) {
  const PointSpread spread = PointSpread::of(1.0);
  Image<float> frame(31, 31);
  double energy = 0;
  for (int l = -3; l <= 3; ++l) {
    for (int k = -3; k <= 3; ++k) {
      const double h = spread.weight(k, 0) * spread.weight(l, 0);
      frame.view()(20 + k, 11 + l) = static_cast<float>(30 * h);
      energy += h * h;
    }
  }
  MatchedFilter filter(1.0, Device::serial());
  const FrameView response = filter.response(frame.view());
  EXPECT_NEAR(response(20, 11), 30 * std::sqrt(energy), 1e-3);
  EXPECT_NEAR(response(19, 11), response(21, 11), 1e-3);
  EXPECT_NEAR(response(20, 10), response(20, 12), 1e-3);
  EXPECT_LT(response(20, 10), response(20, 11));
  EXPECT_LT(response(19, 11), response(20, 11));
}

}  // namespace
}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/find_points/find_points.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "glint/kernels/core/point_spread.hpp"
#include "glint/kernels/core/random.hpp"
#include "kernels/special_floats.hpp"

namespace glint {
namespace {

using Mode = FindPoints::Mode;

Image<float> image(int width, std::initializer_list<float> pixels) {
  Image<float> map(width, static_cast<int>(pixels.size()) / width);
  int i = 0;
  for (const float p : pixels) map.view()(i % width, i / width) = p, ++i;
  return map;
}

/// The same points on both devices, or the test fails.
std::vector<Point> points_of(FrameView map, float threshold, Mode mode = Mode::local_maximum,
                             int radius = 1) {
  std::vector<Point> serial, fast;
  const auto args = [&](std::vector<Point>& points) {
    return FindPoints::Args{
        .map = map, .mode = mode, .threshold = threshold, .radius = radius, .points = &points};
  };
  Device::serial().run<FindPoints>(args(serial));
  Device::tbb(2).run<FindPoints>(args(fast));
  EXPECT_EQ(serial.size(), fast.size());
  for (std::size_t i = 0; i < std::min(serial.size(), fast.size()); ++i) {
    EXPECT_NEAR(serial[i].x, fast[i].x, 1e-3);
    EXPECT_NEAR(serial[i].y, fast[i].y, 1e-3);
    EXPECT_EQ(serial[i].amplitude, fast[i].amplitude);
  }
  return serial;
}

TEST(FindPoints, FindsAParabolasVertex) {
  Image<float> map(40, 20);
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 40; ++x) {
      const double dx = x - 17.3, dy = y - 8.8;
      map.view()(x, y) = static_cast<float>(9 - dx * dx - 2 * dy * dy);
    }
  }
  const auto points = points_of(map, 5);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_NEAR(points[0].x, 17.3, 1e-5);
  EXPECT_NEAR(points[0].y, 8.8, 1e-5);
  EXPECT_EQ(points[0].amplitude, map.view()(17, 9));
}

TEST(FindPoints, CentresAPointSpreadWithinATwentiethOfAPixel) {
  const PointSpread spread = PointSpread::of(1.2);
  for (double dx = -0.5; dx <= 0.5; dx += 0.1) {
    Image<float> map(41, 31);
    for (int y = -3; y <= 3; ++y) {
      for (int x = -3; x <= 3; ++x) {
        map.view()(20 + x, 15 + y) =
            static_cast<float>(100 * spread.weight(x, dx * 0.98) * spread.weight(y, -dx * 0.5));
      }
    }
    const auto points = points_of(map, 5);
    ASSERT_EQ(points.size(), 1u) << dx;
    EXPECT_NEAR(points[0].x, 20 + dx * 0.98, 0.05);
    EXPECT_NEAR(points[0].y, 15 - dx * 0.5, 0.05);
  }
}

TEST(FindPoints, NeedsMoreThanTheThreshold) {
  const auto map = image(3, {0, 0, 0, 0, 2, 0, 0, 0, 0});
  EXPECT_EQ(points_of(map, 2).size(), 0u);
  EXPECT_EQ(points_of(map, std::nextafter(2.0f, 0.0f)).size(), 1u);
  EXPECT_EQ(points_of(map, kInfinity).size(), 0u);
  EXPECT_EQ(points_of(map, kNan).size(), 0u);
}

TEST(FindPoints, GivesATieToTheFirstInRowOrder) {
  const auto row = points_of(image(5, {0, 3, 3, 0, 0}), 1);
  ASSERT_EQ(row.size(), 1u);
  EXPECT_EQ(row[0].x, 1.5f);  // the parabola sees the equal neighbour
  const auto column = points_of(image(1, {0, 3, 3, 0}), 1);
  ASSERT_EQ(column.size(), 1u);
  EXPECT_EQ(column[0].y, 1.5f);
  const auto diagonal = points_of(image(3, {0, 0, 3, 0, 3, 0, 0, 0, 0}), 1);
  ASSERT_EQ(diagonal.size(), 1u);
  EXPECT_EQ(diagonal[0].x, 2);
  EXPECT_EQ(points_of(image(3, {3, 3, 3, 3, 3, 3, 3, 3, 3}), 1).size(), 1u);
}

TEST(FindPoints, ClipsAtTheBorderAndDoesNotShiftThere) {
  const auto corner = points_of(image(3, {5, 4, 0, 4, 0, 0, 0, 0, 0}), 1);
  ASSERT_EQ(corner.size(), 1u);
  EXPECT_EQ(corner[0], (Point{0, 0, 5}));
  const auto edge = points_of(image(4, {1, 4, 3, 0, 0, 0, 0, 0}), 1);
  ASSERT_EQ(edge.size(), 1u);
  EXPECT_GT(edge[0].x, 1.0f);
  EXPECT_EQ(edge[0].y, 0.0f);
}

TEST(FindPoints, ReadsNothingBeyondTheMap) {
  Image<float> big(64, 16);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 64; ++x) big.view()(x, y) = 100;
  }
  ImageView<float> inner{&big.view()(20, 4), 21, 7, big.view().pitch};
  for (int y = 0; y < 7; ++y) {
    for (int x = 0; x < 21; ++x) inner(x, y) = 0;
  }
  inner(0, 0) = inner(20, 6) = inner(20, 0) = 7;
  EXPECT_EQ(points_of(inner, 1).size(), 3u);
  EXPECT_EQ(points_of(inner, 1, Mode::local_maximum, 7).size(), 2u);  // one ties with another
}

TEST(FindPoints, IgnoresNanAndDoesNotShiftTowardsIt) {
  const auto points = points_of(image(3, {kNan, 0, 0, kNan, 5, 4, 0, kNan, 0}), 1);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0], (Point{1, 1, 5}));
  EXPECT_TRUE(points_of(image(2, {kNan, kNan, kNan, kNan}), -kInfinity).empty());
  const auto infinite = points_of(image(3, {1, kInfinity, 2}), 1);
  ASSERT_EQ(infinite.size(), 1u);
  EXPECT_EQ(infinite[0], (Point{1, 0, kInfinity}));
}

TEST(FindPoints, TakesAnEmptyMap) {
  EXPECT_TRUE(points_of({}, 0).empty());
  EXPECT_TRUE(points_of({}, 0, Mode::unit_5x5).empty());
}

TEST(FindPoints, MatchesBruteForceOnTies) {
  std::uint32_t draws = 0;
  const auto random = [&] { return random_words(random_key(5, 0, Purpose::trial), draws++).w[0]; };
  for (int round = 0; round < 60; ++round) {
    const int width = 1 + static_cast<int>(random() % 90);
    const int height = 1 + static_cast<int>(random() % 9);
    Image<float> map(width, height);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) map.view()(x, y) = static_cast<float>(random() % 4);
    }
    const int radius = static_cast<int>(random() % 4);
    std::vector<std::pair<int, int>> want;
    const FrameView m = map.view();
    for (int i = 0; i < width * height; ++i) {
      bool best = m(i % width, i / width) > 1;
      for (int j = 0; j < width * height; ++j) {
        const bool near =
            std::abs(i % width - j % width) <= radius && std::abs(i / width - j / width) <= radius;
        const float a = m(i % width, i / width), b = m(j % width, j / width);
        if (near && (b > a || (b == a && j < i))) best = false;
      }
      if (best) want.emplace_back(i % width, i / width);
    }
    const auto points = points_of(map, 1, Mode::local_maximum, radius);
    ASSERT_EQ(points.size(), want.size()) << width << 'x' << height << " radius " << radius;
    for (std::size_t i = 0; i < want.size(); ++i) {
      EXPECT_NEAR(points[i].x, want[i].first, 0.5);
      EXPECT_NEAR(points[i].y, want[i].second, 0.5);
    }
  }
}

TEST(FindPoints, UnitsAreBlocksWhoseMeanExceedsTheThreshold) {
  Image<float> map(20, 10);
  for (int y = 5; y < 10; ++y) {
    for (int x = 10; x < 15; ++x) map.view()(x, y) = 2;
  }
  EXPECT_TRUE(points_of(map, 2, Mode::unit_5x5).empty());
  const auto points = points_of(map, 1.9f, Mode::unit_5x5);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0], (Point{12, 7, 2}));  // a flat block's centre
  map.view()(14, 5) = 27;
  const auto bright = points_of(map, 2.9f, Mode::unit_5x5);
  ASSERT_EQ(bright.size(), 1u);
  EXPECT_EQ(bright[0], (Point{14, 5, 3}));  // all that is above the block's minimum
}

TEST(FindPoints, UnitsInterpolateTheCentroid) {
  Image<float> map(100, 7);
  map.view()(91, 1) = 30, map.view()(94, 3) = 10;
  const auto points = points_of(map, 1, Mode::unit_5x5);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_NEAR(points[0].x, 91.75, 1e-5);
  EXPECT_NEAR(points[0].y, 1.5, 1e-6);
  EXPECT_NEAR(points[0].amplitude, 40 / 25.0, 1e-6);
}

TEST(FindPoints, UnitsAtTheBorderAndWithMaskedPixelsUseWhatTheyHave) {
  Image<float> map(7, 6);
  map.view()(6, 5) = 4, map.view()(5, 5) = 1;
  auto points = points_of(map, 2, Mode::unit_5x5);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0], (Point{6, 5, 2.5f}));
  map.view()(5, 5) = kNan;
  points = points_of(map, 3, Mode::unit_5x5);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0], (Point{6, 5, 4}));
  map.view()(6, 5) = -kInfinity;
  EXPECT_TRUE(points_of(map, 0, Mode::unit_5x5).empty());
}

TEST(FindPoints, AWarmCallKeepsItsMemory) {
  Image<float> map(700, 600);
  for (int i = 0; i < 60; ++i) map.view()(10 * i + 5, 10 * i + 5) = 9;
  std::vector<Point> points;
  PointWorkspace workspace;
  const FindPoints::Args args{
      .map = map.view(), .threshold = 1, .points = &points, .workspace = &workspace};
  const Device device = Device::tbb(2);
  device.run<FindPoints>(args);
  ASSERT_EQ(points.size(), 60u);
  const Point* data = points.data();
  const auto* scratch = workspace.tiles.back().scratch.data();
  const auto* tile = workspace.tiles.back().points.data();
  map.view()(3, 590) = 9;  // a point more than ever still fits
  device.run<FindPoints>(args);
  EXPECT_EQ(points.size(), 61u);
  EXPECT_EQ(points.data(), data);
  EXPECT_EQ(workspace.tiles.back().scratch.data(), scratch);
  EXPECT_EQ(workspace.tiles.back().points.data(), tile);
}

}  // namespace
}  // namespace glint

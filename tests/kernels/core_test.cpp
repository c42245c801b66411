// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "glint/kernels/core/device.hpp"
#include "glint/kernels/core/frame.hpp"
#include "glint/kernels/core/particles.hpp"
#include "glint/kernels/core/point_spread.hpp"
#include "glint/kernels/core/tiles.hpp"
#include "glint/kernels/core/trial.hpp"

namespace glint {
namespace {

template <class T>
bool aligned(const T* p) {
  return reinterpret_cast<std::uintptr_t>(p) % 64 == 0;
}

TEST(Image, HasAlignedRowsAndNoPowerOfTwoPitch) {
  for (int width = 0; width <= 5000; ++width) {
    for (const std::size_t size : {1u, 2u, 4u, 8u}) {
      const auto pitch = static_cast<std::size_t>(padded_pitch(width, size));
      ASSERT_NE(pitch & (pitch - 1), 0u) << width << " elements of " << size;
      ASSERT_EQ(pitch * size % 64, 0u) << width << " elements of " << size;
      ASSERT_GE(pitch, static_cast<std::size_t>(width) + kImageMargin);
    }
  }
  Image<float> image(641, 7);
  for (int y = 0; y < 7; ++y) EXPECT_TRUE(aligned(image.view().row(y)));
  Image<std::uint16_t> words(641, 7);
  for (int y = 0; y < 7; ++y) EXPECT_TRUE(aligned(words.view().row(y)));
}

TEST(Image, HasAMarginOfZerosOnEverySide) {
  Image<float> image(37, 5);
  const ImageView<float> view = image.view();
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 37; ++x) view(x, y) = 1;
  }
  for (int y = -kImageMargin; y < 5 + kImageMargin; ++y) {
    for (int x = -kImageMargin; x < 37 + kImageMargin; ++x) {
      ASSERT_EQ(view(x, y), view.contains(x, y) ? 1.0f : 0.0f) << x << ' ' << y;
    }
  }
}

TEST(Image, TakesEmptyAndRefusesNegativeSizes) {
  Image<float> none;
  const Image<float>& seen = none;
  EXPECT_EQ(none.view().data, nullptr);
  EXPECT_EQ(seen.view().data, nullptr);
  EXPECT_TRUE(Image<float>(0, 0).view().empty());
  EXPECT_TRUE(Image<float>(0, 9).view().empty());
  EXPECT_THROW(Image<float>(-1, 3), std::invalid_argument);
  EXPECT_THROW(Image<float>(3, -1), std::invalid_argument);
}

TEST(Frame, SharesOneImage) {
  Image<float> image(4, 3);
  image.view()(2, 1) = 5;
  const Frame frame(std::move(image));
  const Frame copy = frame;  // NOLINT(performance-unnecessary-copy-initialization): under test
  EXPECT_EQ(copy.view().data, frame.view().data);
  EXPECT_EQ(copy.view()(2, 1), 5);
  EXPECT_EQ(copy.width(), 4);
  EXPECT_EQ(copy.height(), 3);
  EXPECT_FALSE(Frame());
  EXPECT_TRUE(Frame().view().empty());
}

TEST(Frame, FetchesItsPixelsOnceAndOnlyForThoseWhoLook) {
  int fetched = 0;
  const Frame frame(std::make_shared<const Image<float>>(4, 3), [&] { ++fetched; });
  const Frame other = frame;  // NOLINT(performance-unnecessary-copy-initialization): what is tested
  EXPECT_EQ(frame.for_kernels().width, 4);
  EXPECT_EQ(frame.width(), 4);
  EXPECT_EQ(fetched, 0);
  EXPECT_EQ(frame.view().data, frame.for_kernels().data);
  EXPECT_EQ(other.view().height, 3);
  EXPECT_EQ(fetched, 1);
}

TEST(Frame, TriesAgainAfterAFetchThatFailed) {
  bool works = false;
  const Frame frame(std::make_shared<const Image<float>>(4, 3), [&] {
    if (!works) throw std::runtime_error("the device is gone");
  });
  EXPECT_THROW(frame.view(), std::runtime_error);
  works = true;
  EXPECT_EQ(frame.view().width, 4);
}

TEST(Box, ContainsItsLowerEdgesOnly) {
  const Box box{1, 2, 4, 6};
  EXPECT_TRUE(box.contains(1, 2));
  EXPECT_TRUE(box.contains(3, 5));
  EXPECT_FALSE(box.contains(4, 5));
  EXPECT_FALSE(box.contains(3, 6));
}

TEST(Particles, ResizeEveryArrayAndAlignIt) {
  Particles p;
  p.resize(101);
  int arrays = 0;
  p.for_each_array([&](const auto& a) {
    EXPECT_EQ(a.size(), 101u);
    EXPECT_TRUE(aligned(a.data()));
    ++arrays;
  });
  EXPECT_EQ(arrays, 10);
}

TEST(Tiles, CutItemsIntoAdjacentPieces) {
  for (const std::size_t count : {0u, 1u, 63u, 64u, 65u, 1000u}) {
    const Tiles tiles{count, 64};
    std::size_t next = 0;
    for (std::size_t t = 0; t < tiles.tiles(); ++t) {
      EXPECT_EQ(tiles.begin(t), next);
      EXPECT_GT(tiles.end(t), tiles.begin(t));
      EXPECT_LE(tiles.end(t) - tiles.begin(t), 64u);
      next = tiles.end(t);
    }
    EXPECT_EQ(next, count);
  }
}

TEST(PointSpread, WeightsAreSharesOfOne) {
  for (const double sigma : {0.5, 0.7, 1.0, 2.0}) {
    PointSpread spread = PointSpread::of(sigma);
    for (const double offset : {-0.5, -0.2, 0.0, 0.31, 0.5}) {
      double seen = 0, all = 0, mean = 0;
      for (int k = -40; k <= 40; ++k) {
        const double w = spread.weight(k, offset);
        all += w, mean += w * k;
        if (std::abs(k) <= spread.half_width) seen += w;
      }
      EXPECT_NEAR(all, 1, 1e-12);
      EXPECT_NEAR(mean, offset, 0.03);
      EXPECT_GT(seen, 0.95);
      EXPECT_LT(seen, 1);
      EXPECT_NEAR(spread.weight(2, offset), spread.weight(-2, -offset), 1e-16);
    }
  }
}

TEST(PointSpread, CentresItsWeightsInTheWindow) {
  const PointSpread spread = PointSpread::of(0.7);
  const auto w = spread.centred_weights();
  EXPECT_EQ(spread.half_width, 2);
  EXPECT_EQ(spread.width(), 5);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(w[i], spread.weight(static_cast<int>(i) - 2, 0));
  for (std::size_t i = 5; i < w.size(); ++i) EXPECT_EQ(w[i], 0);
}

TEST(PointSpread, HasTheIntensitiesOfThePapersSnr) {  // P-PHD (5)
  const PointSpread wide = PointSpread::of(0.7), narrow = PointSpread::of(0.6);
  EXPECT_NEAR(wide.intensity_of_snr(12), 12.257, 5e-4);
  EXPECT_NEAR(wide.intensity_of_snr(10), 9.736, 5e-4);
  EXPECT_NEAR(wide.intensity_of_snr(8), 7.733, 5e-4);
  EXPECT_NEAR(narrow.intensity_of_snr(13), 10.104, 5e-4);
  EXPECT_NEAR(narrow.intensity_of_snr(11), 8.026, 5e-4);
}

TEST(PointSpread, HasAWindowOfThreeSigmaAndALargest) {
  EXPECT_EQ(PointSpread::of(0.6).half_width, 1);
  EXPECT_EQ(PointSpread::of(1).half_width, 3);
  EXPECT_EQ(PointSpread::of(2.66).half_width, kMaxHalfWidth);
  for (const double bad : {0.0, -1.0, 2.67, 1e300, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(PointSpread::of(bad), std::invalid_argument) << bad;
  }
}

TEST(Isa, ListsFromPlainToTheBest) {
  const auto isas = runnable_isas();
  ASSERT_FALSE(isas.empty());
  EXPECT_EQ(isas.front(), Isa::plain);
  EXPECT_EQ(isas.back(), best_isa());
  for (std::size_t i = 1; i < isas.size(); ++i) EXPECT_LT(isas[i - 1], isas[i]);
  EXPECT_EQ(name(Isa::v3), "x86-64-v3");
}

TEST(Device, IsNamed) {
  EXPECT_EQ(Device::named("serial").kind(), DeviceKind::serial);
  EXPECT_EQ(Device::named("tbb", 3).kind(), DeviceKind::tbb);
  EXPECT_EQ(Device::named("auto").kind(), DeviceKind::tbb);
  EXPECT_EQ(Device::named("tbb", 3).workers().threads(), 3);
  EXPECT_GE(Device::tbb().workers().threads(), 1);
  EXPECT_NE(Device::named("tbb", 3).description().find("3 threads"), std::string::npos);
}

TEST(Device, NamesTheChoicesForAWrongName) {
  try {
    Device::named("gpu");
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(e.what(), "device 'gpu' is not known: use auto, serial, tbb, egl or egl:N");
  }
}

class WorkersThreads : public testing::TestWithParam<int> {
 protected:
  tbb::global_control eight_{tbb::global_control::max_allowed_parallelism, 8};
  Workers workers_{GetParam()};
};
INSTANTIATE_TEST_SUITE_P(Threads, WorkersThreads, testing::Values(1, 2, 3, 8));

TEST_P(WorkersThreads, CallEachTileOnce) {
  for (const std::size_t tiles : {0u, 1u, 2u, 7u, 1000u}) {
    std::vector<std::atomic<int>> calls(tiles);
    workers_.for_tiles(tiles, [&](std::size_t t) { ++calls.at(t); });
    for (const auto& c : calls) EXPECT_EQ(c.load(), 1);
  }
}

TEST_P(WorkersThreads, LetAnExceptionOut) {
  const auto fail = [](std::size_t t) {
    if (t == 11) throw std::runtime_error("tile 11");
  };
  EXPECT_THROW(workers_.for_tiles(50, fail), std::runtime_error);
  EXPECT_NO_THROW(workers_.for_tiles(11, fail));
}

TEST_P(WorkersThreads, MayBeNested) {
  std::atomic<int> calls = 0;
  workers_.for_tiles(9, [&](std::size_t) { workers_.for_tiles(9, [&](std::size_t) { ++calls; }); });
  EXPECT_EQ(calls.load(), 81);
  int seen = 0;
  workers_.execute([&] { seen = 5; });
  EXPECT_EQ(seen, 5);
}

TEST(Compare, FindsTheFirstMismatchOfEachOutput) {
  const std::vector<Output> want{{"a", {0.1, 0}, {1, 2, 3}}, {"b", {}, {1}}};
  EXPECT_TRUE(compare(want, want).empty());
  const auto found = compare(want, {{"a", {}, {1.05, 2.2, 9}}, {"b", {}, {1, 1}}});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].output, "a");
  EXPECT_EQ(found[0].index, 1u);
  EXPECT_EQ(found[0].got, 2.2);
  EXPECT_EQ(found[1].index, 1u);
  EXPECT_EQ(compare(want, {want[0]}).size(), 1u);
}

TEST(Compare, TakesNanAndInfinityAsEqualToThemselvesOnly) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto equal = [](double want, double got) {
    return compare({{"a", {1, 1}, {want}}}, {{"a", {1, 1}, {got}}}).empty();
  };
  EXPECT_TRUE(equal(kNan, kNan));
  EXPECT_TRUE(equal(-kInfinity, -kInfinity));
  EXPECT_FALSE(equal(kNan, 1));
  EXPECT_FALSE(equal(1, kNan));
  EXPECT_FALSE(equal(kInfinity, 1));
  EXPECT_FALSE(equal(1, kInfinity));
  EXPECT_FALSE(equal(kInfinity, -kInfinity));
}

}  // namespace
}  // namespace glint

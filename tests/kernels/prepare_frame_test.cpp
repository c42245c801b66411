// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/prepare_frame/prepare_frame.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "egl.hpp"
#include "glint/kernels/core/gl_context.hpp"
#include "glint/kernels/core/gl_queue.hpp"
#include "glint/kernels/parity.hpp"
#include "glint/kernels/prepare_frame/median_network.hpp"
#include "glint/kernels/prepare_frame/trial_images.hpp"
#include "kernels/special_floats.hpp"

namespace glint {
namespace {

Image<float> filled(int width, int height, float value) {
  Image<float> image(width, height);
  for (int y = 0; y < height; ++y) std::fill_n(image.view().row(y), width, value);
  return image;
}

/// Every fact holds for the reference and for the fast path.
class PrepareFrame : public testing::TestWithParam<DeviceKind> {
 protected:
  Device device_ = GetParam() == DeviceKind::serial ? Device::serial() : Device::tbb(2);
};
INSTANTIATE_TEST_SUITE_P(Devices, PrepareFrame,
                         testing::Values(DeviceKind::serial, DeviceKind::tbb),
                         [](const auto& kind) { return std::string(name(kind.param)); });

TEST_P(PrepareFrame, ToGreyWeighsBlueGreenRedAndIgnoresAlpha) {
  const std::array<std::uint8_t, 8> pixels{100, 0, 0, 255, 10, 20, 30, 7};
  Image<float> grey(2, 1);
  device_.run<ToGrey>({{pixels.data(), 2, 1, 4, 8}, false, 12, grey.view()});
  EXPECT_NEAR(grey.view()(0, 0), 11.4, 1e-5);
  EXPECT_NEAR(grey.view()(1, 0), .2989 * 30 + .587 * 20 + .114 * 10, 1e-5);
}

TEST_P(PrepareFrame, ToGreyKeepsSixteenBitsAndFloorsTheReciprocal) {
  const std::array<std::uint16_t, 3> pixels{65535, 0, 51};
  Image<float> grey(3, 1);
  device_.run<ToGrey>({{pixels.data(), 3, 1, 1, 3}, false, 12, grey.view()});
  EXPECT_EQ(grey.view()(0, 0), 65535.0F);
  device_.run<ToGrey>({{pixels.data(), 3, 1, 1, 3}, true, 12, grey.view()});
  EXPECT_NEAR(grey.view()(1, 0), 255.0 / 12, 1e-5);
  EXPECT_NEAR(grey.view()(2, 0), 5, 1e-5);
}

TEST_P(PrepareFrame, ToGreyReportsPixelsThatAreNoNumbers) {
  std::array<float, 3> pixels{1, std::numeric_limits<float>::infinity(), kNan};
  Image<float> grey(3, 1);
  bool masked = false;
  device_.run<ToGrey>({{pixels.data(), 3, 1, 1, 3}, false, 12, grey.view(), &masked});
  EXPECT_TRUE(masked);
  EXPECT_EQ(grey.view()(0, 0), 1);
  EXPECT_TRUE(std::isnan(grey.view()(1, 0)) && std::isnan(grey.view()(2, 0)));
  pixels = {1, 2, 3};
  device_.run<ToGrey>({{pixels.data(), 3, 1, 1, 3}, false, 12, grey.view(), &masked});
  EXPECT_FALSE(masked);
}

TEST_P(PrepareFrame, ToGreyTakesPixelsWhoseSquaresOverflowForBadOnes) {
  const float last = ToGrey::kLargest, most = std::numeric_limits<float>::max();
  const std::array<float, 4> pixels{last, -last, 1.001F * last, -most};
  Image<float> grey(4, 1);
  bool masked = false;
  device_.run<ToGrey>({{pixels.data(), 4, 1, 1, 4}, false, 12, grey.view(), &masked});
  EXPECT_TRUE(masked);
  EXPECT_EQ(grey.view()(0, 0), last);
  EXPECT_EQ(grey.view()(1, 0), -last);
  EXPECT_TRUE(std::isnan(grey.view()(2, 0)) && std::isnan(grey.view()(3, 0)));
}

TEST(MedianNetwork, SortsTheMiddleOfEveryInputOfZerosAndOnes) {
  for (int n = 1; n <= 16; ++n) {
    const MedianNetwork network = median_network(n);
    for (unsigned input = 0; input < 1U << n; ++input) {
      unsigned bits = input;
      for (int s = 0; s < network.count; ++s) {
        const unsigned low = network.steps[s].low, high = network.steps[s].high;
        const unsigned a = bits >> low & 1U, b = bits >> high & 1U;
        bits &= ~(1U << low | 1U << high);
        bits |= (a & b) << low | (a | b) << high;
      }
      const int ones = std::popcount(input);
      ASSERT_EQ(bits >> network.lower & 1U, n - ones <= network.lower ? 1U : 0U) << n;
      ASSERT_EQ(bits >> network.upper & 1U, n - ones <= network.upper ? 1U : 0U) << n;
    }
  }
}

TEST(MedianNetwork, FitsItsTableForTheLargestStack) {
  EXPECT_LE(median_network(static_cast<int>(kMaxStack)).count, 640);
  EXPECT_LT(median_network(15).count, 60);
}

TEST_P(PrepareFrame, StackMedianTakesTheMiddleAndLeavesOutWhatIsNoNumber) {
  std::array<Image<float>, 4> images{filled(3, 1, 1), filled(3, 1, 9), filled(3, 1, 2),
                                     filled(3, 1, 4)};
  images[1].view()(1, 0) = kNan;
  for (auto& image : images) image.view()(2, 0) = kNan;
  std::vector<FrameView> views(images.begin(), images.end());
  Image<float> median(3, 1);
  device_.run<StackMedian>({std::span<const FrameView>(views), median.view()});
  EXPECT_EQ(median.view()(0, 0), 3);
  EXPECT_EQ(median.view()(1, 0), 2);
  EXPECT_TRUE(std::isnan(median.view()(2, 0)));
}

TEST_P(PrepareFrame, SpatialMedianForgetsAPointAndKeepsARamp) {
  Image<float> image(41, 30);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 41; ++x) image.view()(x, y) = static_cast<float>(x);
  }
  image.view()(20, 15) = 1000;
  Image<float> median(41, 30);
  device_.run<SpatialMedian>({image.view(), 3, median.view()});
  EXPECT_EQ(median.view()(20, 15), 20);
  EXPECT_EQ(median.view()(10, 5), 10);
  EXPECT_EQ(median.view()(0, 0), 0);
}

TEST_P(PrepareFrame, StructureIsHalfTheStepWithinThreePixelsOfAnEdge) {
  Image<float> image(30, 9);
  for (int y = 0; y < 9; ++y) {
    for (int x = 10; x < 30; ++x) image.view()(x, y) = 8;
  }
  image.view()(25, 4) = kNan;
  Image<float> structure(30, 9);
  device_.run<BackgroundStructure>({image.view(), structure.view()});
  for (int x = 0; x < 30; ++x) {
    EXPECT_EQ(structure.view()(x, 4), x >= 7 && x <= 12 ? 4.0F : 0.0F) << x;
  }
}

TEST_P(PrepareFrame, RobustSpreadIgnoresOutliersAndIsZeroForAConstant) {
  Image<float> image(5, 1);
  const std::array<float, 5> values{1, 2, 3, 4, 1000};
  std::copy(values.begin(), values.end(), image.view().row(0));
  Spread spread;
  device_.run<RobustSpread>({image.view(), {}, nullptr, &spread});
  EXPECT_NEAR(spread.median, 3, 1e-6);
  EXPECT_NEAR(spread.sigma, 1.4826, 1e-5);
  device_.run<RobustSpread>({image.view(), image.view(), nullptr, &spread});
  EXPECT_EQ(spread.sigma, 0);
}

struct WhitenScene {
  explicit WhitenScene(int width, int height)
      : image(width, height), background(width, height), z(width, height), noise(width, height) {
    args.image = image.view();
    args.background = background.view();
    args.ring_outer = 15, args.ring_inner = 5, args.ring_clip = 10;
    args.clip_low = -3, args.clip_high = 8;
    args.whitened = z.view();
    args.noise = noise.view();
  }
  Image<float> image, background, z, noise;
  Whiten::Args args;
};

TEST_P(PrepareFrame, WhitenDividesByTheRingAroundAPixelNotByThePixel) {
  WhitenScene s(64, 64);
  s.image.view()(32, 32) = 10;
  device_.run<Whiten>(s.args);
  EXPECT_EQ(s.z.view()(32, 32), 8);
  EXPECT_EQ(s.noise.view()(32, 32), 1);
  EXPECT_EQ(s.noise.view()(32 + 5, 32), 1) << "inside the inner box";
  EXPECT_EQ(s.noise.view()(32 + 16, 32), 1) << "outside the outer box";
  s.args.sigma = 0.1;
  device_.run<Whiten>(s.args);
  const double clipped_rms = 1 / std::sqrt(31.0 * 31 - 11 * 11);  // 10 sigma in one pixel
  EXPECT_NEAR(s.noise.view()(32 + 6, 32), std::max(0.1, clipped_rms), 1e-4);
}

TEST_P(PrepareFrame, WhitenRaisesSigmaWhereTheSurroundingsAreRestless) {
  WhitenScene s(80, 80);
  for (int y = 0; y < 80; ++y) {
    for (int x = 40; x < 80; ++x) s.image.view()(x, y) = (x + y) % 2 == 0 ? 4.0F : -4.0F;
  }
  device_.run<Whiten>(s.args);
  EXPECT_NEAR(s.noise.view()(60, 40), 4, 1e-3);
  EXPECT_NEAR(s.noise.view()(79, 79), 4, 1e-3) << "the ring is cut at the corner";
  EXPECT_EQ(s.noise.view()(10, 40), 1);
}

TEST_P(PrepareFrame, WhitenMasksAndLeavesMaskedPixelsOutOfTheRings) {
  WhitenScene s(60, 50), clean(60, 50);
  for (int y = 20; y < 30; ++y) {
    for (int x = 20; x < 30; ++x) s.image.view()(x, y) = kNan;
  }
  s.background.view()(40, 40) = kNan;
  for (int y = 0; y < 50; ++y) {
    for (int x = 0; x < 60; ++x) {
      const float texture = (x + y) % 2 == 0 ? 3.0F : -3.0F;
      s.image.view()(x, y) += texture;
      clean.image.view()(x, y) = texture;
    }
  }
  device_.run<Whiten>(s.args);
  device_.run<Whiten>(clean.args);
  EXPECT_EQ(s.z.view()(25, 25), 0);
  EXPECT_TRUE(std::isnan(s.noise.view()(25, 25)));
  EXPECT_EQ(s.z.view()(40, 40), 0);
  EXPECT_NEAR(s.noise.view()(32, 25), 3, 1e-3) << "a known pixel beside masked ones";
  EXPECT_NEAR(s.z.view()(10, 10), clean.z.view()(10, 10), 1e-4);
}

TEST_P(PrepareFrame, WhitenTurnsTheSignByPolarity) {
  WhitenScene s(3, 1);
  s.args.ring_outer = 0;
  s.image.view()(0, 0) = 2, s.image.view()(1, 0) = -2;
  device_.run<Whiten>(s.args);
  EXPECT_EQ(s.z.view()(0, 0), 2);
  s.args.polarity = Polarity::dark;
  device_.run<Whiten>(s.args);
  EXPECT_EQ(s.z.view()(0, 0), -2);
  EXPECT_EQ(s.z.view()(1, 0), 2);
  s.args.polarity = Polarity::both;
  device_.run<Whiten>(s.args);
  EXPECT_EQ(s.z.view()(0, 0), s.z.view()(1, 0));
  EXPECT_NEAR(s.z.view()(0, 0), 2 - std::sqrt(2 / 3.14159265), 1e-4);
}

struct Registered {
  Shift shift;
  Image<float> still, moved;
};

Registered registered(const Device& device, double dx, double dy) {
  Registered r{{}, scenery(160, 120, 0, 1), Image<float>(160, 120)};
  ShiftImage::serial({r.still.view(), dx, dy, r.moved.view()});
  const RandomKey key = random_key(5, 0, Purpose::trial);
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      const Normals4 noise = random_normals(key, static_cast<std::uint32_t>(y * 160 + x));
      r.still.view()(x, y) += noise.n[0];
      r.moved.view()(x, y) += noise.n[1];
    }
  }
  Image<float> coarse[2] = {Image<float>(80, 60), Image<float>(80, 60)};
  Halve::serial({r.moved.view(), coarse[0].view()});
  Halve::serial({r.still.view(), coarse[1].view()});
  const FrameView reference[] = {r.moved.view(), coarse[0].view()};
  const FrameView moving[] = {r.still.view(), coarse[1].view()};
  device.run<EstimateShift>({reference, moving, 16, &r.shift});
  return r;
}

TEST_P(PrepareFrame, EstimateShiftFindsAFractionOfAPixel) {
  for (const auto& [dx, dy] : {std::pair{5.0, -3.0}, {0.4, 0.3}, {-7.3, 2.6}}) {
    const Shift shift = registered(device_, dx, dy).shift;
    EXPECT_NEAR(shift.dx, dx, 0.1);
    EXPECT_NEAR(shift.dy, dy, 0.1);
    EXPECT_TRUE(shift.improves(0.2)) << dx;
  }
}

TEST_P(PrepareFrame, EstimateShiftOfAStillSceneDoesNotPay) {
  EXPECT_FALSE(registered(device_, 0, 0).shift.improves(0.2));
}

TEST_P(PrepareFrame, ShiftImageMovesWholePixelsExactlyAndKnowsNothingBeyond) {
  const Image<float> image = scenery(20, 10, 3, 1);
  Image<float> moved(20, 10);
  device_.run<ShiftImage>({image.view(), 2, -1, moved.view()});
  EXPECT_EQ(moved.view()(4, 5), image.view()(6, 4));
  EXPECT_EQ(moved.view()(17, 1), image.view()(19, 0));
  EXPECT_TRUE(std::isnan(moved.view()(18, 1)));
  EXPECT_TRUE(std::isnan(moved.view()(4, 0)));
}

/// All but the many trials of to_grey, and those whose ring alone has too many wide rows.
std::vector<std::unique_ptr<Trial>> window_trials() {
  Trials trials;
  add_background_trials(trials);
  add_registration_trials(trials);
  add_whiten_trials(trials);
  std::erase_if(trials,
                [](const auto& t) { return t->description().starts_with("whiten 1025x9"); });
  return trials;
}

TEST(EglPrepareFrame, GivesTheSameBitsInBandsOfAFewRows) {
  GLINT_NEEDS_EGL(device);
  constexpr std::size_t kBytes = std::size_t{40} << 10;
  const Device small = Device::egl(device.context().device().number);
  small.context().run([](gl::Queue& queue) { queue.limit(kBytes); });
  const std::array devices{device, small};
  for (const ParityRow& row : check_parity("prepare_frame", window_trials(), devices)) {
    EXPECT_TRUE(row.ok()) << description(row);
  }
}

}  // namespace
}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/propagate/propagate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "propagate_cases.hpp"

namespace glint::test {
namespace {

INSTANTIATE_TEST_SUITE_P(Devices, PropagateOn, testing::Values(DeviceKind::serial, DeviceKind::tbb),
                         [](const auto& instance) { return std::string(name(instance.param)); });

TEST_P(PropagateOn, MovesStraightWithoutNoise) {
  Particles p = same(70);
  Propagate::Args args = args_of(p, std::span(&kVelocity, 1));
  args.step = 2;
  device_.run<Propagate>(args);
  for (std::size_t i = 0; i < p.size(); ++i) {
    EXPECT_EQ(p.x[i], 106);
    EXPECT_EQ(p.y[i], 42);
    EXPECT_EQ(p.vx[i], 3);
    EXPECT_EQ(p.vy[i], -4);
    EXPECT_EQ(p.ax[i], 0.5f);
    EXPECT_EQ(p.intensity[i], 10);
  }
}

TEST_P(PropagateOn, AcceleratesWithoutNoise) {
  Particles p = same(70);
  Propagate::Args args = args_of(p, std::span(&kAcceleration, 1));
  args.step = 2;
  device_.run<Propagate>(args);
  for (std::size_t i = 0; i < p.size(); ++i) {
    EXPECT_EQ(p.x[i], 107);
    EXPECT_EQ(p.y[i], 42.5f);
    EXPECT_EQ(p.vx[i], 4);
    EXPECT_EQ(p.vy[i], -3.5f);
    EXPECT_EQ(p.ay[i], 0.25f);
  }
}

// Positive rates turn from +x to +y as stored: anticlockwise on a plot with y up.
TEST_P(PropagateOn, TurnsFromXToYForAPositiveRate) {
  Particles p = same(70);
  for (std::size_t i = 0; i < p.size(); ++i) p.vx[i] = 2, p.vy[i] = 0;
  const MotionMode quarter = turn(std::numbers::pi / 2);
  device_.run<Propagate>(args_of(p, std::span(&quarter, 1)));
  const double radius = 2 / (std::numbers::pi / 2);
  for (std::size_t i = 0; i < p.size(); ++i) {
    EXPECT_NEAR(p.vx[i], 0, 1e-6);
    EXPECT_NEAR(p.vy[i], 2, 1e-6);
    EXPECT_NEAR(p.x[i], 100 + radius, 2e-5);
    EXPECT_NEAR(p.y[i], 50 + radius, 2e-5);
  }
}

TEST_P(PropagateOn, AFullTurnReturns) {
  Particles p = same(3);
  const MotionMode twelfth = turn(-std::numbers::pi / 6);
  for (int k = 0; k < 12; ++k) device_.run<Propagate>(args_of(p, std::span(&twelfth, 1)));
  EXPECT_NEAR(p.x[1], 100, 1e-3);
  EXPECT_NEAR(p.y[1], 50, 1e-3);
  EXPECT_NEAR(p.vx[1], 3, 1e-4);
}

TEST_P(PropagateOn, AVerySlowTurnIsStraight) {
  Particles p = same(3), q = same(3);
  const MotionMode slow = turn(1e-20);
  device_.run<Propagate>(args_of(p, std::span(&slow, 1)));
  device_.run<Propagate>(args_of(q, std::span(&kVelocity, 1)));
  EXPECT_EQ(p.x[2], q.x[2]);
  EXPECT_EQ(p.y[2], q.y[2]);
}

const float kSwitching[] = {0.8f, 0.15f, 0.05f, 0.3f, 0.7f, 0, 0.25f, 0.25f, 0.5f};

TEST_P(PropagateOn, ModesSwitchAsOftenAsTheMatrixSays) {
  Particles p = same(kSamples);
  for (std::size_t i = 0; i < p.size(); ++i) p.mode[i] = static_cast<std::uint32_t>(i % 3);
  const MotionMode modes[] = {kVelocity, turn(0.1), turn(-0.1)};
  Propagate::Args args = args_of(p, modes);
  args.switching = kSwitching;
  device_.run<Propagate>(args);
  double count[3][3] = {};
  for (std::size_t i = 0; i < p.size(); ++i) ++count[i % 3][p.mode[i]];
  const double from = kSamples / 3.0;
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      const double want = kSwitching[3 * a + b];
      EXPECT_NEAR(count[a][b] / from, want, 4.5 * std::sqrt(want * (1 - want) / from) + 1e-9);
    }
  }
}

// The stationary distribution by its defining property.
TEST_P(PropagateOn, ModesStayStationary) {
  double share[3] = {1, 0, 0};
  for (int k = 0; k < 500; ++k) {
    double next[3] = {};
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) next[b] += share[a] * kSwitching[3 * a + b];
    }
    std::copy(next, next + 3, share);
  }
  Particles p = same(kSamples);
  const MotionMode modes[] = {kVelocity, turn(0.1), turn(-0.1)};
  for (std::uint32_t frame = 0; frame < 25; ++frame) {
    Propagate::Args args = args_of(p, modes);
    args.switching = kSwitching;
    args.frame = frame;
    device_.run<Propagate>(args);
  }
  double count[3] = {};
  for (const std::uint32_t mode : p.mode) ++count[mode];
  for (int m = 0; m < 3; ++m) EXPECT_NEAR(count[m] / kSamples, share[m], 0.01);
}

TEST_P(PropagateOn, MovesByTheModeAfterTheSwitch) {
  Particles p = same(130);
  const MotionMode modes[] = {kVelocity, kAcceleration};
  const float always[] = {0, 1, 1, 0};
  Propagate::Args args = args_of(p, modes);
  args.switching = always;
  device_.run<Propagate>(args);
  for (std::size_t i = 0; i < p.size(); ++i) {
    EXPECT_EQ(p.mode[i], 1u);
    EXPECT_EQ(p.vx[i], 3.5f);
  }
}

TEST_P(PropagateOn, IntensityStaysInItsRangeHoweverFarItWalks) {
  Particles p = same(5000);
  Propagate::Args args = args_of(p, std::span(&kVelocity, 1));
  args.intensity_noise = 100;
  device_.run<Propagate>(args);
  float low = 12, high = 8;
  for (const float v : p.intensity) low = std::min(low, v), high = std::max(high, v);
  EXPECT_EQ(low, 8);
  EXPECT_LE(high, 12);
  EXPECT_GT(high, 11.9f);
}

TEST_P(PropagateOn, IntensityIsReflectedNotClipped) {
  Particles p = same(1000), q = same(1000);
  Propagate::Args args = args_of(p, std::span(&kVelocity, 1));
  args.intensity_noise = 0.01f;
  args.intensity_low = 0, args.intensity_high = 100;
  device_.run<Propagate>(args);
  args = args_of(q, std::span(&kVelocity, 1));
  args.intensity_noise = 0.01f;
  args.intensity_low = 9, args.intensity_high = 10;
  device_.run<Propagate>(args);
  for (std::size_t i = 0; i < p.size(); ++i) {
    EXPECT_NEAR(q.intensity[i], 10 - std::abs(p.intensity[i] - 10), 1e-5);
  }
}

TEST_P(PropagateOn, APartMovesAsItDoesInTheWhole) {
  const MotionMode modes[] = {{Motion::constant_velocity, 0, 1}, {Motion::coordinated_turn, 1, 1}};
  const float switching[] = {0.5f, 0.5f, 0.5f, 0.5f};
  Particles whole = same(9000), part = same(5000);
  for (Particles* p : {&whole, &part}) {
    Propagate::Args args = args_of(*p, modes);
    args.switching = switching;
    args.intensity_noise = 0.1f;
    device_.run<Propagate>(args);
  }
  for (std::size_t i = 0; i < part.size(); ++i) {
    ASSERT_EQ(part.x[i], whole.x[i]) << i;
    ASSERT_EQ(part.mode[i], whole.mode[i]) << i;
    ASSERT_EQ(part.intensity[i], whole.intensity[i]) << i;
  }
}

TEST_P(PropagateOn, OtherSeedsAndFramesDrawOtherNoise) {
  const MotionMode mode{Motion::constant_velocity, 0, 1};
  Particles p = same(1), q = same(1), r = same(1);
  Propagate::Args a = args_of(p, std::span(&mode, 1)), b = args_of(q, std::span(&mode, 1)),
                  c = args_of(r, std::span(&mode, 1));
  b.seed += 1ull << 32;
  c.frame += 1;
  for (const auto& args : {a, b, c}) device_.run<Propagate>(args);
  EXPECT_NE(p.x[0], q.x[0]);
  EXPECT_NE(p.x[0], r.x[0]);
}

TEST_P(PropagateOn, RefusesWrongArguments) {
  Particles p = same(4);
  const MotionMode modes[] = {kVelocity, kVelocity};
  EXPECT_THROW(device_.run<Propagate>(args_of(p, {})), std::invalid_argument);
  EXPECT_THROW(device_.run<Propagate>(args_of(p, modes)), std::invalid_argument);
  Propagate::Args args = args_of(p, modes);
  const float leaky[] = {0.9f, 0, 0, 1};
  args.switching = leaky;
  EXPECT_THROW(device_.run<Propagate>(args), std::invalid_argument);
  args = args_of(p, std::span(&kAcceleration, 1));
  args.ax = {};
  EXPECT_THROW(device_.run<Propagate>(args), std::invalid_argument);
  args = args_of(p, std::span(&kVelocity, 1));
  args.y = args.y.first(3);
  EXPECT_THROW(device_.run<Propagate>(args), std::invalid_argument);
}

}  // namespace
}  // namespace glint::test

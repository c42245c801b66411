// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/core/math.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "kernels/special_floats.hpp"

namespace glint {
namespace {

/// |got - want| in units of the last place of want as float.
double ulps(float got, double want) {
  const int exponent = std::ilogb(want);
  return std::abs(got - want) / std::ldexp(1.0, std::max(exponent, -126) - 23);
}

/// Calls f(x) for about `steps` floats from low to high, evenly spaced.
template <class F>
void sweep(double low, double high, int steps, F f) {
  for (int i = 0; i <= steps; ++i) f(static_cast<float>(low + (high - low) * i / steps));
}

TEST(Math, ExpIsWithinItsBound) {
  double worst = 0;
  sweep(-87, 88, 400000,
        [&](float x) { worst = std::max(worst, ulps(math::exp(x), std::exp(double{x}))); });
  sweep(-1, 1, 400000,
        [&](float x) { worst = std::max(worst, ulps(math::exp(x), std::exp(double{x}))); });
  EXPECT_LE(worst, 1.06);
  EXPECT_GT(worst, 0.5);  // else the sweep saw nothing
  RecordProperty("ulps", std::to_string(worst));
}

TEST(Math, ExpIsBounded) {
  EXPECT_EQ(math::exp(0), 1.0f);
  EXPECT_EQ(math::exp(-87.1f), 0.0f);
  EXPECT_EQ(math::exp(-kInfinity), 0.0f);
  EXPECT_EQ(math::exp(kInfinity), math::exp(88));
  EXPECT_TRUE(std::isfinite(math::exp(88)));
}

TEST(Math, LogIsWithinItsBound) {
  double worst = 0;
  const auto look = [&](float x) {
    if (x == 1) return;
    worst = std::max(worst, ulps(math::log(x), std::log(double{x})));
  };
  for (std::int32_t i = 0x00800000; i < 0x7f800000; i += 4001) look(math::from_bits(i));
  sweep(0.5, 2, 500000, look);
  EXPECT_LE(worst, 0.87);
  EXPECT_GT(worst, 0.5);
  EXPECT_EQ(math::log(1), 0.0f);
  RecordProperty("ulps", std::to_string(worst));
}

TEST(Math, SinCosOfTurnsAreWithin1e7) {
  double worst = 0;
  const auto look = [&](float u) {
    const double angle = 2 * std::numbers::pi * (double{u} - std::round(double{u}));
    const auto [s, c] = math::sincos_turns(u);
    worst = std::max({worst, std::abs(s - std::sin(angle)), std::abs(c - std::cos(angle))});
  };
  sweep(-1, 2, 500000, look);
  sweep(-1048575, 1048575, 200000, look);
  EXPECT_LE(worst, 1.2e-7);
  EXPECT_GT(worst, 1e-8);
  RecordProperty("error", std::to_string(worst * 1e7) + "e-7");
}

TEST(Math, SinCosOfQuarterTurnsAreExact) {
  const float sines[] = {0, 1, 0, -1};
  for (int k = -8; k <= 8; ++k) {
    const auto [s, c] = math::sincos_turns(0.25f * static_cast<float>(k));
    EXPECT_EQ(s, sines[k & 3]) << k;
    EXPECT_EQ(c, sines[(k + 1) & 3]) << k;
  }
}

TEST(Math, ErfIsWithinItsBound) {
  double worst = 0;
  sweep(-5, 5, 500000,
        [&](float x) { worst = std::max(worst, std::abs(math::erf(x) - std::erf(double{x}))); });
  EXPECT_LE(worst, 4e-7);
  EXPECT_GT(worst, 1e-8);
  EXPECT_EQ(math::erf(0), 0.0f);
  EXPECT_NEAR(math::erf(40), 1, 4e-7);
  EXPECT_EQ(math::erf(-1.5f), -math::erf(1.5f));
  RecordProperty("error", std::to_string(worst * 1e7) + "e-7");
}

TEST(Math, ClampKeepsNan) {
  EXPECT_EQ(math::clamp(3, 0, 2), 2.0f);
  EXPECT_EQ(math::clamp(-3, 0, 2), 0.0f);
  EXPECT_EQ(math::clamp(1, 0, 2), 1.0f);
  EXPECT_TRUE(std::isnan(math::clamp(kNan, 0, 2)));
}

}  // namespace
}  // namespace glint

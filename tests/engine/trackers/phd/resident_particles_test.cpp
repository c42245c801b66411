// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/resident_particles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "engine/trackers/phd/few_particles.hpp"
#include "glint/engine/state/fields.hpp"

namespace glint {
namespace {

using namespace test;

/// Every value is another one.
Particles numbered(std::size_t count) {
  Particles p;
  p.resize(count);
  int next = 1;
  p.for_each_array([&](auto& values) {
    for (auto& v : values) v = static_cast<std::remove_reference_t<decltype(v)>>(next++);
  });
  return p;
}

void expect_equal(const Particles& a, const Particles& b) {
  EXPECT_TRUE(Particles::fields(a) == Particles::fields(b));
}

TEST(ResidentParticles, AreTheSameAfterBytes) {
  ResidentParticles saved{Device::serial()}, loaded{Device::serial()};
  saved.resize(3);
  saved.arrays() = numbered(3);
  ByteWriter to;
  put_bytes(to, saved);
  loaded.resize(7);
  ByteReader from(to.bytes());
  take_bytes(from, loaded);
  EXPECT_EQ(loaded.size(), 3U);
  EXPECT_EQ(from.left(), 0U);
  expect_equal(loaded.arrays(), numbered(3));
}

TEST(ResidentParticles, RefuseArraysOfUnlikeLengths) {
  Particles uneven = numbered(3);
  uneven.mode.resize(2);
  ByteWriter to;
  put_bytes(to, uneven);
  ByteReader from(to.bytes());
  ResidentParticles loaded{Device::serial()};
  EXPECT_THROW(take_bytes(from, loaded), BytesError);
}

TEST(ResidentParticles, ExchangeTheirWeightsAndNothingElse) {
  ResidentParticles p{Device::serial()};
  p.resize(3);
  p.arrays() = numbered(3);
  ResidentArray<float> weight{Device::serial()};
  weight.resize(3);
  std::ranges::fill(weight.values(), 9.0F);
  p.swap_weight(weight);
  Particles expected = numbered(3);
  EXPECT_TRUE(std::ranges::equal(weight.values(), expected.weight));
  expected.weight = {9, 9, 9};
  expect_equal(p.arrays(), expected);
}

TEST(ResidentParticles, ChangePlaces) {
  ResidentParticles a{Device::serial()}, b{Device::serial()};
  a.resize(2), a.arrays() = numbered(2);
  std::swap(a, b);
  EXPECT_EQ(a.size(), 0U);
  expect_equal(b.arrays(), numbered(2));
}

TEST(MovedParticles, AreAllArraysButTheWeightEachToItself) {
  const Particles from = numbered(4);
  Particles to = numbered(3);
  const Particles before = to;
  // Of the particles from 1 on number 2 goes to place 1 of those from 1 on.
  for (const MovedArray& array : moved_particles(from, 1, to, 1)) array.move(2, 1);
  Particles expected = before;
  const auto set = [&](auto member) { (expected.*member)[2] = (from.*member)[3]; };
  set(&Particles::x), set(&Particles::y), set(&Particles::vx), set(&Particles::vy);
  set(&Particles::ax), set(&Particles::ay), set(&Particles::intensity);
  set(&Particles::mode), set(&Particles::label);
  expect_equal(to, expected);
}

}  // namespace
}  // namespace glint

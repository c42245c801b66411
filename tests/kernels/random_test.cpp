// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/core/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace glint {
namespace {

void expect_words(Words4 got, Words4 want) {
  for (int i = 0; i < 4; ++i) EXPECT_EQ(got.w[i], want.w[i]) << "word " << i;
}

// Known answers of Random123 1.14, tests/kat_vectors.
TEST(Threefry4x32, KnowsTheAnswersForZeros) {
  const Words4 zero{{0, 0, 0, 0}};
  expect_words(threefry<13>(zero, zero), {{0x531c7e4f, 0x39491ee5, 0x2c855a92, 0x3d6abf9a}});
  expect_words(threefry<20>(zero, zero), {{0x9c6ca96a, 0xe17eae66, 0xfc10ecd4, 0x5256a7d8}});
}

TEST(Threefry4x32, KnowsTheAnswersForOnes) {
  const Words4 ones{{~0u, ~0u, ~0u, ~0u}};
  expect_words(threefry<13>(ones, ones), {{0xc4189358, 0x1c9cc83a, 0xd5881c67, 0x6a0a89e0}});
  expect_words(threefry<20>(ones, ones), {{0x2a881696, 0x57012287, 0xf6c7446e, 0xa16a6732}});
}

TEST(Threefry4x32, KnowsTheAnswersForPi) {
  const Words4 counter{{0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}};
  const Words4 key{{0xa4093822, 0x299f31d0, 0x082efa98, 0xec4e6c89}};
  expect_words(threefry<13>(counter, key), {{0x4aa71d8f, 0x734738c2, 0x431fc6a8, 0xae6debf1}});
  expect_words(threefry<20>(counter, key), {{0x59cd1dbb, 0xb8879579, 0x86b5d00c, 0xac8b6d84}});
}

TEST(RandomWords, DifferInEveryPartOfTheirAddress) {
  const RandomKey base = random_key(1, 2, Purpose::birth);
  std::set<std::uint32_t> seen;
  for (const RandomKey& key :
       {base, random_key(2, 2, Purpose::birth), random_key(1ull << 32 | 1, 2, Purpose::birth),
        random_key(1, 3, Purpose::birth), random_key(1, 2, Purpose::jitter)}) {
    for (const std::uint32_t item : {0u, 1u, 70000u}) {
      for (const std::uint32_t draw : {0u, 1u}) {
        for (const std::uint32_t w : random_words(key, item, draw).w) seen.insert(w);
      }
    }
  }
  EXPECT_EQ(seen.size(), 5u * 3 * 2 * 4);
  expect_words(random_words(base, 9, 1), random_words(base, 9, 1));
}

TEST(Uniform, LiesInsideTheOpenUnitInterval) {
  EXPECT_EQ(uniform(0), 0x1p-25f);
  EXPECT_GT(uniform(0), 0.0f);
  EXPECT_LE(uniform(~0u), 1.0f);
  EXPECT_NEAR(uniform(0x80000000u), 0.5, 1e-7);
}

constexpr int kDraws = 1 << 20;

/// Normals of (key, item) for items 0 .. kDraws / 4.
std::vector<double> normals(RandomKey key, std::uint32_t draw = 0) {
  std::vector<double> all;
  for (std::uint32_t item = 0; item < kDraws / 4; ++item) {
    for (const float n : random_normals(key, item, draw).n) all.push_back(n);
  }
  return all;
}

double moment(const std::vector<double>& a, int power) {
  double sum = 0;
  for (const double x : a) sum += std::pow(x, power);
  return sum / static_cast<double>(a.size());
}

double correlation(const std::vector<double>& a, const std::vector<double>& b, std::size_t lag) {
  double sum = 0;
  for (std::size_t i = lag; i < a.size(); ++i) sum += a[i] * b[i - lag];
  return sum / static_cast<double>(a.size() - lag);
}

TEST(RandomNormals, HaveTheMomentsOfANormal) {
  const auto n = normals(random_key(7, 3, Purpose::propagate));
  const double scale = 5 / std::sqrt(kDraws);  // five standard errors
  EXPECT_NEAR(moment(n, 1), 0, scale);
  EXPECT_NEAR(moment(n, 2), 1, scale * std::sqrt(2.0));
  EXPECT_NEAR(moment(n, 3), 0, scale * std::sqrt(15.0));
  EXPECT_NEAR(moment(n, 4), 3, scale * std::sqrt(96.0));
}

TEST(RandomNormals, HaveTheTailsOfANormal) {
  const auto n = normals(random_key(8, 3, Purpose::propagate));
  for (const double z : {1.0, 2.0, 3.0, 4.0}) {
    const double p = std::erfc(z / std::sqrt(2.0)) / 2, sd = std::sqrt(kDraws * p * (1 - p));
    const auto above = std::count_if(n.begin(), n.end(), [z](double x) { return x > z; });
    const auto below = std::count_if(n.begin(), n.end(), [z](double x) { return x < -z; });
    EXPECT_NEAR(static_cast<double>(above), kDraws * p, 5 * sd) << z;
    EXPECT_NEAR(static_cast<double>(below), kDraws * p, 5 * sd) << z;
  }
  EXPECT_LT(*std::max_element(n.begin(), n.end()), 5.9);  // 24 bits reach sqrt(2 ln 2^25) = 5.89
}

TEST(RandomNormals, AreIndependentOfTheirNeighboursAndOfOtherStreams) {
  const RandomKey key = random_key(9, 5, Purpose::propagate);
  const auto n = normals(key);
  const double bound = 5 / std::sqrt(kDraws);
  for (const std::size_t lag : {1u, 2u, 3u, 4u, 5u, 8u, 64u}) {
    EXPECT_NEAR(correlation(n, n, lag), 0, bound) << "lag " << lag;
  }
  EXPECT_NEAR(correlation(n, normals(key, 1), 0), 0, bound) << "draw";
  EXPECT_NEAR(correlation(n, normals(random_key(9, 5, Purpose::birth)), 0), 0, bound);
  EXPECT_NEAR(correlation(n, normals(random_key(9, 6, Purpose::propagate)), 0), 0, bound);
  EXPECT_NEAR(correlation(n, normals(random_key(10, 5, Purpose::propagate)), 0), 0, bound);
}

}  // namespace
}  // namespace glint

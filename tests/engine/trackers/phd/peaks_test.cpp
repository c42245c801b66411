// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/peaks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "glint/engine/trackers/phd/kmeans.hpp"
#include "glint/kernels/core/cells.hpp"
#include "glint/kernels/core/random.hpp"

namespace glint {
namespace {

struct Cloud {
  double x, y, mass;
  int count;
};

constexpr int kWidth = 60, kHeight = 50;
constexpr PeakConfig kHalfATarget{.threshold = 0.5, .radius = 2.5};

Particles clouds(const std::vector<Cloud>& clouds) {
  Particles p;
  for (const auto& c : clouds) {
    for (int i = 0; i < c.count; ++i) {
      const auto item = static_cast<std::uint32_t>(p.size());
      const auto n = random_normals(random_key(3, 0, Purpose::trial), item);
      p.resize(item + 1);
      p.x[item] = static_cast<float>(c.x) + 0.4f * n.n[0];
      p.y[item] = static_cast<float>(c.y) + 0.4f * n.n[1];
      p.vx[item] = 1, p.vy[item] = -2, p.intensity[item] = 10;
      p.mode[item] = 0, p.label[item] = 0;
      p.weight[item] = static_cast<float>(c.mass / c.count);
    }
  }
  return p;
}

CellRuns runs_of(const Particles& p, int width = kWidth, int height = kHeight) {
  std::vector<float> zero(p.size(), 0.0f), updated(p.size());
  CellWorkspace cells;
  CellWeights::serial({.width = width,
                       .height = height,
                       .half_width = 2,
                       .x = p.x,
                       .y = p.y,
                       .predicted = p.weight,
                       .log_ratio = zero,
                       .updated = updated,
                       .workspace = &cells});
  // Grouped by cell there; the masses wanted here are the weights as they are.
  for (std::size_t r = 0; r < cells.runs.size(); ++r) {
    cells.runs.mass[r] = 0;
    for (auto k = cells.runs.first[r]; k < cells.runs.first[r + 1]; ++k) {
      cells.runs.mass[r] += p.weight[cells.runs.order[k]];
    }
  }
  return cells.runs;
}

std::vector<Peak> find(const Particles& p, PeakFinder& finder, PeakConfig config = kHalfATarget) {
  const auto found = finder.find(p, runs_of(p), kWidth, kHeight, 2, config);
  return {found.begin(), found.end()};
}

TEST(Peaks, AreTheCloudsThatHoldHalfATarget) {
  const Particles p = clouds({{20.3, 10.6, 1.0, 400}, {40, 30, 0.7, 300}, {10, 40, 0.3, 200}});
  PeakFinder finder;
  const auto peaks = find(p, finder);
  ASSERT_EQ(peaks.size(), 2u);
  EXPECT_NEAR(peaks[0].x, 20.3, 0.1);
  EXPECT_NEAR(peaks[0].y, 10.6, 0.1);
  EXPECT_NEAR(peaks[0].mass, 1.0, 1e-3);
  EXPECT_NEAR(peaks[1].x, 40, 0.1);
  EXPECT_NEAR(peaks[1].mass, 0.7, 1e-3);
  EXPECT_NEAR(peaks[0].vx, 1, 1e-6);
  EXPECT_NEAR(peaks[0].vy, -2, 1e-6);
  EXPECT_NEAR(peaks[0].var_x, 0.16, 0.04);
}

TEST(Peaks, HoldEachParticleAtMostOnce) {
  const Particles p = clouds({{20, 10, 1.0, 300}, {23, 11, 0.9, 300}, {21, 13, 0.8, 300}});
  PeakFinder finder;
  find(p, finder);
  std::vector<std::uint32_t> members(finder.members().begin(), finder.members().end());
  std::sort(members.begin(), members.end());
  EXPECT_EQ(std::adjacent_find(members.begin(), members.end()), members.end());
  EXPECT_GT(members.size(), 600u);
}

TEST(Peaks, MassesSumToAtMostTheCloud) {
  const Particles p = clouds({{20, 10, 2.5, 500}, {22, 12, 1.5, 500}});
  PeakFinder finder;
  double sum = 0;
  for (const auto& peak : find(p, finder)) sum += peak.mass;
  EXPECT_LE(sum, 4.0 + 1e-3);
}

TEST(Peaks, DoNotDependOnTheOrderOfTheParticles) {
  const Particles p = clouds({{20.2, 10.1, 1.0, 200}, {40.4, 30.7, 0.8, 200}});
  Particles reversed = p;
  reversed.for_each_array([](auto& a) { std::reverse(a.begin(), a.end()); });
  PeakFinder a, b;
  const auto want = find(p, a), got = find(reversed, b);
  ASSERT_EQ(want.size(), got.size());
  for (std::size_t i = 0; i < want.size(); ++i) {
    EXPECT_NEAR(want[i].x, got[i].x, 1e-9);
    EXPECT_NEAR(want[i].mass, got[i].mass, 1e-6);
  }
}

// Its cells are beyond 2^31.
TEST(Peaks, AreFoundInTheFarCornerOfTheLargestFrame) {
  const double far = kMaxSide - 5;
  const Particles p = clouds({{far, far, 1.0, 300}});
  PeakFinder finder;
  const auto peaks = finder.find(p, runs_of(p, kMaxSide, kMaxSide), kMaxSide, kMaxSide, 2, kHalfATarget);
  ASSERT_EQ(peaks.size(), 1u);
  EXPECT_NEAR(peaks[0].x, far, 0.1);
  EXPECT_NEAR(peaks[0].y, far, 0.1);
  EXPECT_NEAR(peaks[0].mass, 1.0, 1e-3);
}

TEST(Peaks, OfAnEmptyCloudAreNone) {
  PeakFinder finder;
  EXPECT_TRUE(find(Particles{}, finder).empty());
}

TEST(Kmeans, SplitsIntoTheRoundedMass) {
  const Particles p = clouds({{10, 10, 1.0, 200}, {50, 40, 1.0, 200}});
  std::vector<std::uint32_t> members;
  const auto states = kmeans_states(p, random_key(1, 0, Purpose::kmeans), members);
  EXPECT_EQ(states.size(), 2u);
  EXPECT_EQ(members.size(), p.size());
}

TEST(Kmeans, OfLessThanHalfATargetIsNone) {
  std::vector<std::uint32_t> members;
  const auto states =
      kmeans_states(clouds({{10, 10, 0.4, 50}}), random_key(1, 0, Purpose::kmeans), members);
  EXPECT_TRUE(states.empty());
}

}  // namespace
}  // namespace glint

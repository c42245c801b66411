// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/peaks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

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
  const auto peaks =
      finder.find(p, runs_of(p, kMaxSide, kMaxSide), kMaxSide, kMaxSide, 2, kHalfATarget);
  ASSERT_EQ(peaks.size(), 1u);
  EXPECT_NEAR(peaks[0].x, far, 0.1);
  EXPECT_NEAR(peaks[0].y, far, 0.1);
  EXPECT_NEAR(peaks[0].mass, 1.0, 1e-3);
}

TEST(Peaks, OfAnEmptyCloudAreNone) {
  PeakFinder finder;
  EXPECT_TRUE(find(Particles{}, finder).empty());
}

Particles two_particles() {
  Particles p;
  p.resize(2);
  p.x = {10, 14}, p.y = {5, 9}, p.vx = {1, 5}, p.vy = {0, -4};
  p.ax = p.ay = {0, 0};
  p.intensity = {20, 40}, p.weight = {0.6F, 0.2F}, p.mode = {0, 2}, p.label = {0, 0};
  return p;
}

// Weights .75 and .25: means and covariances by hand, model probabilities P-PHD (35).
TEST(DescribeCluster, GivesTheWeightedMoments) {
  const Particles p = two_particles();
  const std::vector<std::uint32_t> members{0, 1};
  const Peak peak = describe_cluster(p, members, p.weight);
  EXPECT_NEAR(peak.mass, 0.8, 1e-6);
  EXPECT_NEAR(peak.x, 11, 1e-6);
  EXPECT_NEAR(peak.y, 6, 1e-6);
  EXPECT_NEAR(peak.vx, 2, 1e-6);
  EXPECT_NEAR(peak.vy, -1, 1e-6);
  EXPECT_NEAR(peak.intensity, 25, 1e-5);
  EXPECT_NEAR(peak.var_x, 3, 1e-5);  // .75 * 1 + .25 * 9
  EXPECT_NEAR(peak.cov_xy, 3, 1e-5);
  EXPECT_NEAR(peak.var_y, 3, 1e-5);
  EXPECT_NEAR(peak.mode_probability[0], 0.75, 1e-6);
  EXPECT_NEAR(peak.mode_probability[1], 0, 1e-6);
  EXPECT_NEAR(peak.mode_probability[2], 0.25, 1e-6);
}

// Off the means by (-1, -2, -3, 5) and (3, 6, 9, -15).
TEST(DescribeCluster, GivesTheCovarianceOfVelocity) {
  Particles p = two_particles();
  p.x = {10, 14}, p.y = {20, 28}, p.vx = {-3, 9}, p.vy = {5, -15};
  const std::vector<std::uint32_t> members{0, 1};
  const Peak peak = describe_cluster(p, members, p.weight);
  EXPECT_NEAR(peak.cov_x_vx, 9, 1e-5);    // .75 * 3 + .25 * 27
  EXPECT_NEAR(peak.cov_x_vy, -15, 1e-5);  // .75 * -5 + .25 * -45
  EXPECT_NEAR(peak.cov_y_vx, 18, 1e-5);
  EXPECT_NEAR(peak.cov_y_vy, -30, 1e-5);
  EXPECT_NEAR(peak.var_vx, 27, 1e-5);
  EXPECT_NEAR(peak.cov_vx_vy, -45, 1e-5);
  EXPECT_NEAR(peak.var_vy, 75, 1e-5);
}

TEST(DescribeCluster, GoesByTheMembersAlone) {
  const Particles p = two_particles();
  const std::vector<std::uint32_t> members{1};
  EXPECT_NEAR(describe_cluster(p, members, p.weight).x, 14, 1e-6);
}

TEST(PointOf, ConvertsVelocityToSecondsAndKeepsTheModelsThereAre) {
  const Particles p = two_particles();
  const std::vector<std::uint32_t> members{0, 1};
  const TrackPoint point = point_of(describe_cluster(p, members, p.weight), 3, {7, 0.25, 1, 30});
  EXPECT_EQ(point.frame, 7);
  EXPECT_EQ(point.time, 0.25);
  EXPECT_NEAR(point.x, 11, 1e-6);
  EXPECT_NEAR(point.y, 6, 1e-6);
  EXPECT_NEAR(point.vx, 60, 1e-4);
  EXPECT_NEAR(point.vy, -30, 1e-4);
  EXPECT_NEAR(point.intensity, 25, 1e-5);
  EXPECT_NEAR(point.cov_xy, 3, 1e-5);
  ASSERT_EQ(point.mode_probability.size(), 3U);
  EXPECT_NEAR(point.mode_probability[2], 0.25, 1e-6);
}

// The heaviest window lies around pixel 22, whose box of 2.5 px ends at 24.5; the mean of the
// particles in it is 22.18, and the box around that holds the last one, too.
TEST(Peaks, MoveToTheMeanOfTheirParticles) {
  Particles p;
  p.resize(4);
  p.x = {20.4F, 22.4F, 24.4F, 24.6F}, p.y = {10, 10, 10, 10};
  p.vx = p.vy = p.ax = p.ay = p.intensity = {0, 0, 0, 0};
  p.weight = {0.3F, 0.4F, 0.2F, 0.1F};
  p.mode = p.label = {0, 0, 0, 0};
  PeakFinder finder;
  const auto peaks = find(p, finder);
  ASSERT_EQ(peaks.size(), 1U);
  EXPECT_EQ(finder.members(peaks[0]).size(), 4U);
  EXPECT_NEAR(peaks[0].mass, 1, 1e-6);
  EXPECT_NEAR(peaks[0].x, 22.42, 1e-5);
}

// A window that holds enough mass is no peak if the box of the cluster does not.
TEST(Peaks, HaveTheLeastMassInTheirOwnBox) {
  const Particles p = clouds({{20, 10, 0.3, 100}, {22, 10, 0.3, 100}});
  PeakFinder finder;
  EXPECT_EQ(find(p, finder).size(), 1U);
  EXPECT_TRUE(find(p, finder, {.threshold = 0.5, .radius = 0.9}).empty());
}

TEST(Peaks, HoldTheParticlesOfTheirBoxAlone) {
  const Particles p = clouds({{20, 10, 0.8, 200}, {26, 10, 0.2, 50}});
  PeakFinder finder;
  const auto peaks = find(p, finder);
  ASSERT_EQ(peaks.size(), 1U);
  EXPECT_NEAR(peaks[0].mass, 0.8, 1e-3);
  EXPECT_NEAR(peaks[0].x, 20, 0.1);
}

}  // namespace
}  // namespace glint

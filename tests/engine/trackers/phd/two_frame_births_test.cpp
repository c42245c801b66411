// SPDX-License-Identifier: Apache-2.0
// The births of births.hpp that are drawn from two frames.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "engine/trackers/phd/births_scene.hpp"

namespace glint {
namespace {

using namespace test;

TEST(TwoFrameBirths, NeedAFrameBeforeOfTheSameSize) {
  Nursery nursery(config_of(BirthProposal::two_frame), dim());
  EXPECT_EQ(nursery.draw(Frame(Image<float>(30, 30))).size(), 0U);
  EXPECT_EQ(nursery.draw(empty_frame()).size(), 0U);
  EXPECT_EQ(nursery.draw(empty_frame()).size(), kCount);
}

/// A pixel of the first frame that lies inside by more than rounding, else nothing.
struct Before {
  double x, y;
  bool certain;
};
Before before(const Particles& p, std::size_t i, double step) {
  const double x = p.x[i] - step * p.vx[i], y = p.y[i] - step * p.vy[i];
  const auto inside = [](double v) { return std::abs(v - std::floor(v + 0.5)) < 0.499; };
  return {x, y, inside(x) && inside(y)};
}

/// Pixels within `reach` of one, inside the frame.
double cells_in_reach(double x, double y, int reach) {
  const auto along = [&](int c) {
    return std::min(kSide - 1, c + reach) - std::max(0, c - reach) + 1;
  };
  return along(pixel_of(x)) * along(pixel_of(y));
}

/// gamma / J * S_b / (2 v_max T)^2 / s_b with equal scores s, so S_b / s_b is the number of cells
/// in reach; 0 beyond the largest speed.
double flat_weight(const Particles& p, std::size_t i, const Before& from, double step) {
  const double speed = std::max(std::abs(p.vx[i]), std::abs(p.vy[i]));
  if (speed > kSpeed) return 0;
  const int reach = static_cast<int>(std::ceil(kSpeed * step));
  return kMass / kCount * cells_in_reach(from.x, from.y, reach) / std::pow(2 * kSpeed * step, 2);
}

TEST(TwoFrameBirths, InFlatFramesWeighTheirReachOverTheRangeOfVelocities) {
  for (const double step : {1.0, 3.0}) {
    Nursery nursery(config_of(BirthProposal::two_frame), dim());
    nursery.draw(empty_frame());
    const Particles p = nursery.draw(empty_frame(), step);
    ASSERT_EQ(p.size(), kCount);
    double sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Before from = before(p, i, step);
      sum += p.weight[i];
      if (!from.certain) continue;
      const double expected = flat_weight(p, i, from, step);
      ASSERT_NEAR(p.weight[i], expected, 0.01 * expected) << i;
    }
    // All of gamma but for the targets that leave the frame: the mean |v| is half the largest.
    const double stay = std::pow(1 - kSpeed / 2 * step / kSide, 2);
    EXPECT_NEAR(sum, stay * kMass, 0.03 * kMass);
  }
}

// What living targets explain of a cell in the frame before, B, leaves 1 / (clutter + B) of it.
TEST(TwoFrameBirths, LeaveToLivingTargetsWhatTheyExplain) {
  Nursery nursery(config_of(BirthProposal::two_frame), dim());
  nursery.clutter = 2;
  // Two pixels held particles, of sums 3 and 5.
  nursery.previous.runs.cell = {cell_at(20, 15, kSide), cell_at(22, 16, kSide)};
  nursery.previous.cell_sum = {3, 5};
  nursery.draw(empty_frame());
  const Particles p = nursery.draw(empty_frame());
  const int half_width = narrow_spread().half_width;
  const auto in_window = [&](const Before& from, int x, int y) {
    return std::abs(pixel_of(from.x) - x) <= half_width &&
           std::abs(pixel_of(from.y) - y) <= half_width;
  };
  std::set<double> seen;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Before from = before(p, i, 1);
    if (!from.certain) continue;
    const double explained = (in_window(from, 20, 15) ? 3 : 0) + (in_window(from, 22, 16) ? 5 : 0);
    const double expected = flat_weight(p, i, from, 1) / (2 + explained);
    ASSERT_NEAR(p.weight[i], expected, 0.01 * expected) << from.x << ' ' << from.y;
    if (expected > 0) seen.insert(explained);
  }
  EXPECT_EQ(seen, (std::set<double>{0, 3, 5, 8}));
}

/// S_b of the cells within `reach` of a pixel.
double score_in_reach(const std::vector<double>& scores, int x, int y, int reach) {
  double sum = 0;
  for (int j = std::max(0, y - reach); j <= std::min(kSide - 1, y + reach); ++j) {
    for (int i = std::max(0, x - reach); i <= std::min(kSide - 1, x + reach); ++i) {
      sum += scores[cell_at(i, j, kSide)];
    }
  }
  return sum;
}

/// l of P-PHD (13) in frame `z`.
double likelihood_ratio(FrameView z, double intensity, double x, double y) {
  const PointSpread s = narrow_spread();
  double matched = 0, energy = 0;
  for (int j = -s.half_width; j <= s.half_width; ++j) {
    for (int i = -s.half_width; i <= s.half_width; ++i) {
      const int px = pixel_of(x) + i, py = pixel_of(y) + j;
      if (!z.contains(px, py)) continue;
      const double w = s.weight(i, x - pixel_of(x)) * s.weight(j, y - pixel_of(y));
      matched += w * z(px, py), energy += w * w;
    }
  }
  return std::exp(intensity * matched - intensity * intensity * energy / 2);
}

// gamma / J * mean(s_{k-1}) / s_{k-1}(a) * l_{k-1}(x_{k-1}) * S_b / (2 v_max T)^2 / s_k(b)
TEST(TwoFrameBirths, AreWeightedAgainstTheirProposalAndByTheFrameBefore) {
  constexpr double kRatio = 20;
  Nursery nursery(config_of(BirthProposal::two_frame), exact_appearance(kRatio));
  const double intensity = intensity_of_ratio(kRatio);
  const Frame first = image_of(kRatio, {{20, 15}}), second = image_of(kRatio, {{21, 14}});
  const auto before_scores = scores_of(first.view(), intensity);
  const auto now_scores = scores_of(second.view(), intensity);
  nursery.draw(first);
  const Particles p = nursery.draw(second);
  int from_the_target = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Before from = before(p, i, 1);
    if (!from.certain || std::max(std::abs(p.vx[i]), std::abs(p.vy[i])) > kSpeed) continue;
    const int ax = pixel_of(from.x), ay = pixel_of(from.y);
    const auto a = cell_at(ax, ay, kSide);
    const auto b = cell_at(pixel_of(p.x[i]), pixel_of(p.y[i]), kSide);
    const double expected = kMass / kCount * mean_of(before_scores) / before_scores[a] *
                            likelihood_ratio(first.view(), intensity, from.x, from.y) *
                            score_in_reach(now_scores, ax, ay, 2) / std::pow(2 * kSpeed, 2) /
                            now_scores[b];
    ASSERT_NEAR(p.weight[i], expected, 0.01 * expected) << from.x << ' ' << from.y;
    from_the_target += a == cell_at(20, 15, kSide) && b == cell_at(21, 14, kSide);
  }
  EXPECT_GT(from_the_target, 5);
}

TEST(TwoFrameBirths, AreNotInTheMask) {
  Nursery nursery(config_of(BirthProposal::two_frame), dim());
  nursery.draw(empty_frame());
  nursery.mask.set(std::vector<Box>{{0, 0, kSide, 20}}, kSide, kSide);
  const Particles p = nursery.draw(empty_frame());
  double alive = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.weight[i] == 0) continue;
    ++alive;
    ASSERT_GT(p.y[i], 19.49F);
  }
  EXPECT_GT(alive, kCount / 10);
}

std::size_t births_in(int width, int height, int growth) {
  BirthConfig config = config_of(BirthProposal::two_frame);
  config.birth_growth = growth;
  Births births(config, motion_of(), Device::serial(), 1);
  births.set_appearance(ready(dim()));
  const CellWorkspace none;
  const PixelMask mask;
  const Frame z{Image<float>(width, height)};
  births.prepare({z, 0, 1, none, 1, mask});
  return births.prepare({z, 1, 1, none, 1, mask});
}

// Of pixels with a score of 1, birth_particles for every 256x256.
TEST(TwoFrameBirths, AreMoreInLargeFramesAsFarAsTheyMayGrow) {
  EXPECT_EQ(births_in(512, 100, 8), kCount);
  EXPECT_EQ(births_in(512, 300, 8), 2 * kCount);
  EXPECT_EQ(births_in(512, 300, 1), kCount);
  EXPECT_EQ(births_in(512, 512, 3), 3 * kCount);
}

TEST(TwoFrameBirths, ForgetTheFrameBeforeWithAnotherAppearance) {
  Births births(config_of(BirthProposal::two_frame), motion_of(), Device::serial(), 1);
  births.set_appearance(ready(dim()));
  const CellWorkspace none;
  const PixelMask mask;
  const Frame z = empty_frame();
  Particles p;
  p.resize(kCount);
  EXPECT_EQ(births.prepare({z, 0, 1, none, 1, mask}), 0U);
  births.set_appearance(ready(dim()));
  EXPECT_EQ(births.prepare({z, 1, 1, none, 1, mask}), 0U);
  EXPECT_EQ(births.prepare({z, 2, 1, none, 1, mask}), kCount);
}

}  // namespace
}  // namespace glint

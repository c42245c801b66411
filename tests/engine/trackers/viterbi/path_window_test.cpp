// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/viterbi/path_window.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace glint {
namespace {

/// A window of 5 stages over a 30x20 frame of this score with a straight path of 10 a stage in it.
PathWindow window_with_path(const Device& device, int first, int last, float elsewhere = -1) {
  PathWindow window(5, 3, device);
  for (int k = 0; k < 5; ++k) {
    const ImageView<float> map = window.next(30, 20);
    for (int y = 0; y < 20; ++y) std::fill_n(map.row(y), 30, elsewhere);
    if (k >= first && k < last) map(5 + 2 * k, 4 + k) = 10;
    window.push({3, 5});  // in a flat first stage ties set the move
  }
  return window;
}

TEST(PathWindow, TracesThePathBack) {
  PathWindow window = window_with_path(Device::tbb(1), 0, 5);
  const auto paths = window.find(30);
  ASSERT_EQ(paths.size(), 1u);
  EXPECT_EQ(paths[0].total, 50);
  EXPECT_EQ(paths[0].first, 0u);
  EXPECT_EQ(paths[0].last, 5u);
  for (int k = 0; k < 5; ++k) {
    EXPECT_EQ(paths[0].cells[static_cast<std::size_t>(k)].x, 5 + 2 * k);
    EXPECT_EQ(paths[0].cells[static_cast<std::size_t>(k)].y, 4 + k);
  }
}

TEST(PathWindow, TrimsStagesThatShowNothing) {
  PathWindow window = window_with_path(Device::tbb(1), 1, 4);
  const auto paths = window.find(20);
  ASSERT_EQ(paths.size(), 1u);
  EXPECT_EQ(paths[0].first, 1u);
  EXPECT_EQ(paths[0].last, 4u);
}

// A cell of 10 between 48 of 10 - ln 2 would leave it half a weight each; here one neighbour to the
// right and two below, diagonally, have that, and all others none.
TEST(PathWindow, WeighsWhatLiesAroundACell) {
  PathWindow window(2, 3, Device::tbb(1));
  const float half = 10 - std::log(2.0F);
  for (int k = 0; k < 2; ++k) {
    const ImageView<float> map = window.next(30, 20);
    for (int y = 0; y < 20; ++y) std::fill_n(map.row(y), 30, -100.0F);
    map(15, 10) = 10, map(16, 10) = map(16, 12) = half;
    window.push({3, 1});
  }
  const auto paths = window.find(15);
  ASSERT_EQ(paths.size(), 1u);
  const WindowPath::Cell& cell = paths[0].cells[1];
  EXPECT_NEAR(cell.weight, 2, 1e-5);
  EXPECT_NEAR(cell.var_x, 0.5 + 1.0 / 12, 1e-5);  // a quarter each at 1 to the right
  EXPECT_NEAR(cell.cov_xy, 0.25 * 2, 1e-5);       // one of them 2 below
  EXPECT_NEAR(cell.var_y, 0.25 * 4 + 1.0 / 12, 1e-5);
  // Twenty for the cells, twice ln 2 for what is near, 600 cells, 7x7 moves.
  EXPECT_NEAR(paths[0].log_odds, 20 + 2 * std::log(2) - std::log(600) - std::log(49), 1e-4);
}

TEST(PathWindow, LaterMovesAreFreeWithinTheToleranceOnly) {
  PathWindow window = window_with_path(Device::tbb(1), 0, 5, -100);  // tolerance 5: 11x11 moves
  const auto paths = window.find(30);
  ASSERT_EQ(paths.size(), 1u);
  EXPECT_NEAR(paths[0].log_odds, 50 - std::log(600) - std::log(49) - 3 * std::log(121), 1e-4);
}

/// A window of 5 stages over a 30x20 frame of -1 with a cell of 10 and one of 9 a stage, at x = 5 +
/// 2 k and y = 4 or `y[k]`.
PathWindow window_with_two(const std::array<int, 5>& y) {
  PathWindow window(5, 3, Device::tbb(1));
  for (int k = 0; k < 5; ++k) {
    const ImageView<float> map = window.next(30, 20);
    for (int row = 0; row < 20; ++row) std::fill_n(map.row(row), 30, -1.0F);
    map(5 + 2 * k, 4) = 10, map(5 + 2 * k, y[static_cast<std::size_t>(k)]) = 9;
    window.push({3, 1});
  }
  return window;
}

TEST(PathWindow, OfTwoPathsWithinSeparationAtOneStageTheBetterIsKept) {
  PathWindow near = window_with_two({18, 15, 12, 9, 6});
  const auto kept = near.find(30);
  ASSERT_EQ(kept.size(), 1u);
  EXPECT_EQ(kept[0].total, 50);
  PathWindow apart = window_with_two({19, 16, 13, 10, 7});  // 3 px at the last stage
  const auto both = apart.find(30);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[0].total, 50);
  EXPECT_EQ(both[1].total, 45);
  EXPECT_EQ(both[1].cells[2].y, 13);
}

/// A window of 4 stages over a 40x9 frame of -1 with a cell of 10 at each `x[k]`, all with `moves`.
PathWindow window_along(const std::array<int, 4>& x, StageMoves moves) {
  PathWindow window(4, 3, Device::tbb(1));
  for (const int at : x) {
    const ImageView<float> map = window.next(40, 9);
    for (int row = 0; row < 9; ++row) std::fill_n(map.row(row), 40, -1.0F);
    map(at, 4) = 10;
    window.push(moves);
  }
  return window;
}

TEST(PathWindow, TakesMovesUpToTheReach) {
  EXPECT_EQ(window_along({5, 8, 11, 14}, {3, 1}).find(15)[0].total, 40);
  const auto total = window_along({5, 9, 13, 17}, {3, 1}).find(5)[0].total;
  EXPECT_LT(total, 40);
}

TEST(PathWindow, TakesChangesOfAMoveUpToTheTolerance) {
  EXPECT_EQ(window_along({5, 6, 9, 10}, {3, 2}).find(15)[0].total, 40);
  EXPECT_LT(window_along({5, 6, 9, 10}, {3, 1}).find(5)[0].total, 40);
}

TEST(PathWindow, ANewStageDropsTheOldest) {
  PathWindow window = window_along({5, 7, 9, 11}, {3, 3});
  const ImageView<float> map = window.next(40, 9);
  for (int row = 0; row < 9; ++row) std::fill_n(map.row(row), 40, -1.0F);
  map(13, 4) = 6;
  window.push({3, 3});
  const auto paths = window.find(15);
  ASSERT_EQ(paths.size(), 1u);
  EXPECT_EQ(paths[0].total, 36);
  for (int k = 0; k < 4; ++k) EXPECT_EQ(paths[0].cells[static_cast<std::size_t>(k)].x, 7 + 2 * k);
}

TEST(PathWindow, KeepsNoPathUnderTheThresholdOrOfAWindowThatIsNotFull) {
  PathWindow window = window_with_path(Device::tbb(1), 0, 2);
  EXPECT_TRUE(window.find(20).empty());
  PathWindow other(2, 3, Device::tbb(1));
  other.next(4, 4), other.push({});
  EXPECT_FALSE(other.full());
}

TEST(PathWindow, AnotherSizeStartsAnew) {
  PathWindow window = window_with_path(Device::tbb(1), 0, 5);
  window.next(8, 8), window.push({});
  EXPECT_FALSE(window.full());
}

}  // namespace
}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/dp_stage/dp_stage.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "glint/kernels/core/random.hpp"

namespace glint {
namespace {

constexpr int kWidth = 7, kHeight = 6;

struct Stage {
  Image<float> total{kWidth, kHeight};
  Image<std::int8_t> dx{kWidth, kHeight}, dy{kWidth, kHeight};
};

/// Whole numbers, so that sums are exact and ties come up.
Image<float> scores(std::uint32_t frame) {
  Image<float> image(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const auto item = static_cast<std::uint32_t>(y * kWidth + x);
      image.view()(x, y) =
          std::floor(100 * uniform(random_words(random_key(3, frame, Purpose::trial), item).w[0]));
    }
  }
  return image;
}

Stage next(const Device& device, const Image<float>& score, const Image<float>& before,
           const Stage* moves, int reach, int tolerance) {
  Stage stage;
  DpStage::Args a;
  a.score = score.view(), a.before = before.view();
  if (moves != nullptr) a.moves = {moves->dx.view(), moves->dy.view()};
  a.reach = reach, a.tolerance = tolerance;
  a.total = stage.total.view(), a.dx = stage.dx.view(), a.dy = stage.dy.view();
  device.run<DpStage>(a);
  return stage;
}

/// The best sum over two moves that end at (x, y), found by looking at all of them: the first move
/// to a cell is the one to the best cell around it, whatever follows.
double brute_force(const std::vector<Image<float>>& s, int x, int y) {
  double best = -INFINITY;
  for (int mx = 0; mx < kWidth; ++mx) {
    for (int my = 0; my < kHeight; ++my) {
      if (std::abs(x - mx) > 2 || std::abs(y - my) > 2) continue;
      int from_x = 0, from_y = 0;
      double first = -INFINITY;
      for (int oy = kHeight - 1; oy >= 0; --oy) {  // the least move is the largest origin
        for (int ox = kWidth - 1; ox >= 0; --ox) {
          if (std::abs(mx - ox) > 2 || std::abs(my - oy) > 2) continue;
          if (s[0].view()(ox, oy) <= first) continue;
          first = s[0].view()(ox, oy), from_x = ox, from_y = oy;
        }
      }
      const bool smooth =
          std::abs((x - mx) - (mx - from_x)) <= 1 && std::abs((y - my) - (my - from_y)) <= 1;
      if (smooth) best = std::max(best, first + s[1].view()(mx, my) + s[2].view()(x, y));
    }
  }
  return best;
}

class DpStageOn : public testing::TestWithParam<DeviceKind> {
 protected:
  Device device_ = Device::named(name(GetParam()));
};
std::string device_name(const testing::TestParamInfo<DeviceKind>& device) {
  return std::string(name(device.param));
}
INSTANTIATE_TEST_SUITE_P(Devices, DpStageOn, testing::Values(DeviceKind::serial, DeviceKind::tbb),
                         device_name);

TEST_P(DpStageOn, FindsWhatAllPathsTogetherGive) {
  const std::vector<Image<float>> s{scores(0), scores(1), scores(2)};
  const Stage first = next(device_, s[1], s[0], nullptr, 2, 1);
  const Stage second = next(device_, s[2], first.total, &first, 2, 1);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      EXPECT_EQ(second.total.view()(x, y), brute_force(s, x, y)) << x << ", " << y;
      if (std::isinf(second.total.view()(x, y))) continue;
      // The moves lead back along cells whose scores add up to the total.
      const int mx = x - second.dx.view()(x, y), my = y - second.dy.view()(x, y);
      const int ox = mx - first.dx.view()(mx, my), oy = my - first.dy.view()(mx, my);
      EXPECT_EQ(s[0].view()(ox, oy) + s[1].view()(mx, my) + s[2].view()(x, y),
                second.total.view()(x, y));
      EXPECT_LE(std::abs(second.dx.view()(x, y) - first.dx.view()(mx, my)), 1);
      EXPECT_LE(std::abs(second.dy.view()(x, y) - first.dy.view()(mx, my)), 1);
    }
  }
}

TEST_P(DpStageOn, TakesTheLeastMoveOfEqualPaths) {
  const Stage stage =
      next(device_, Image<float>(kWidth, kHeight), Image<float>(kWidth, kHeight), nullptr, 1, 0);
  EXPECT_EQ(stage.dx.view()(3, 3), -1);
  EXPECT_EQ(stage.dy.view()(3, 3), -1);
  EXPECT_EQ(stage.dx.view()(kWidth - 1, kHeight - 1), 0);
  EXPECT_EQ(stage.dy.view()(kWidth - 1, kHeight - 1), 0);
}

TEST_P(DpStageOn, GivesCellsThatNoPathReachesMinusInfinity) {
  Stage right;  // all came from the left by 2, and may only go on so
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) right.dx.view()(x, y) = 2;
  }
  const Stage stage = next(device_, scores(1), scores(0), &right, 2, 0);
  EXPECT_EQ(stage.total.view()(1, 3), -INFINITY);
  EXPECT_EQ(stage.total.view()(2, 3), scores(1).view()(2, 3) + scores(0).view()(0, 3));
}

TEST_P(DpStageOn, DoesNotFollowNaN) {
  Image<float> before(kWidth, kHeight);
  before.view()(3, 3) = NAN;
  const Stage stage = next(device_, scores(1), before, nullptr, 1, 0);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      EXPECT_EQ(stage.total.view()(x, y), scores(1).view()(x, y));
    }
  }
}

TEST_P(DpStageOn, RefusesSizesThatDiffer) {
  EXPECT_THROW(next(device_, Image<float>(2, 2), scores(0), nullptr, 1, 0), std::invalid_argument);
  EXPECT_THROW(next(device_, scores(1), scores(0), nullptr, 64, 0), std::invalid_argument);
}

}  // namespace
}  // namespace glint

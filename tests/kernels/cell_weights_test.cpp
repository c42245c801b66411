// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/cell_weights/cell_weights.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "glint/kernels/core/random.hpp"
#include "kernels/special_floats.hpp"

namespace glint {
namespace {

struct WeightedCloud {
  std::vector<float> x, y, predicted, log_ratio, updated;
  CellWorkspace workspace;

  void add(float at_x, float at_y, float weight, float ratio) {
    x.push_back(at_x), y.push_back(at_y), predicted.push_back(weight), log_ratio.push_back(ratio);
    updated.push_back(-1);
  }
  CellWeights::Args args(int width, int height, int half_width = 2) {
    return {.width = width,
            .height = height,
            .half_width = half_width,
            .x = x,
            .y = y,
            .predicted = predicted,
            .log_ratio = log_ratio,
            .updated = updated,
            .workspace = &workspace};
  }
};

WeightedCloud random_cloud(std::size_t n, int width, int height) {
  WeightedCloud cloud;
  for (std::uint32_t i = 0; i < n; ++i) {
    const Words4 words = random_words(random_key(4, 0, Purpose::trial), i);
    cloud.add(uniform(words.w[0]) * static_cast<float>(width + 2) - 1.5f,
              uniform(words.w[1]) * static_cast<float>(height + 2) - 1.5f, uniform(words.w[2]),
              4 * uniform(words.w[3]) - 2);
  }
  return cloud;
}

/// w' by definition: every particle against every other.
std::vector<double> brute_force(const CellWeights::Args& args) {
  const std::size_t n = args.x.size();
  const int reach = args.psi == Psi::window ? args.half_width : 0;
  std::vector<int> column(n), row(n);
  std::vector<double> product(n), result(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    column[i] = static_cast<int>(std::floor(args.x[i] + 0.5f));
    row[i] = static_cast<int>(std::floor(args.y[i] + 0.5f));
    product[i] = args.predicted[i] * std::exp(double{args.log_ratio[i]});
  }
  const auto inside = [&](std::size_t i) {
    return column[i] >= 0 && row[i] >= 0 && column[i] < args.width && row[i] < args.height;
  };
  for (std::size_t i = 0; i < n; ++i) {
    double sum = args.clutter;
    for (std::size_t j = 0; j < n; ++j) {
      const bool near =
          std::abs(column[i] - column[j]) <= reach && std::abs(row[i] - row[j]) <= reach;
      if (inside(j) && near) sum += product[j];
    }
    if (inside(i)) result[i] = product[i] / sum;
  }
  return result;
}

class CellWeightsOn : public testing::TestWithParam<DeviceKind> {
 protected:
  void run(const CellWeights::Args& args) { device_.run<CellWeights>(args); }
  Device device_ = GetParam() == DeviceKind::serial ? Device::serial() : Device::tbb(2);
};
INSTANTIATE_TEST_SUITE_P(Devices, CellWeightsOn,
                         testing::Values(DeviceKind::serial, DeviceKind::tbb),
                         [](const auto& instance) { return std::string(name(instance.param)); });

TEST_P(CellWeightsOn, EqualTheDefinition) {
  for (const auto& [width, height, half_width] :
       {std::tuple{13, 11, 2}, {40, 3, 1}, {1, 9, 7}, {7, 1, 3}, {5, 5, 0}}) {
    for (const Psi psi : {Psi::window, Psi::cell}) {
      WeightedCloud cloud = random_cloud(700, width, height);
      CellWeights::Args args = cloud.args(width, height, half_width);
      args.psi = psi;
      args.clutter = 0.7f;
      run(args);
      const auto want = brute_force(args);
      for (std::size_t i = 0; i < want.size(); ++i) {
        ASSERT_NEAR(cloud.updated[i], want[i], 2e-5 * want[i]) << i;
      }
    }
  }
}

TEST_P(CellWeightsOn, RunsGroupParticlesByPixelInOrder) {
  WeightedCloud cloud;
  for (const auto& [x, y] : {std::pair{2.4f, 1.0f},
                             {0.0f, 0.0f},
                             {1.6f, 1.4f},
                             {-0.6f, 0.0f},
                             {-0.5f, -0.5f},
                             {2.5f, 0.0f},
                             {2.0f, 0.5f}}) {
    cloud.add(x, y, 1, 0);
  }
  run(cloud.args(3, 2));
  const CellRuns& runs = cloud.workspace.runs;
  EXPECT_EQ(runs.cell, (std::vector<std::uint32_t>{0, 5}));
  EXPECT_EQ(runs.first, (std::vector<std::uint32_t>{0, 2, 5}));
  EXPECT_EQ(runs.order, (std::vector<std::uint32_t>{1, 4, 0, 2, 6}));
  EXPECT_EQ(cloud.workspace.cell_sum, (std::vector<float>{2, 3}));
  EXPECT_EQ(cloud.workspace.box_sum, (std::vector<float>{5, 5}));
  EXPECT_EQ(cloud.updated[3], 0);
  EXPECT_EQ(cloud.updated[5], 0);
}

TEST_P(CellWeightsOn, WindowsDoNotWrapAroundTheBorder) {
  WeightedCloud cloud;
  cloud.add(0, 5, 1, 0);
  cloud.add(9, 4, 1, 0);
  cloud.add(9, 6, 1, 0);
  run(cloud.args(10, 10));
  EXPECT_FLOAT_EQ(cloud.updated[0], 0.5f);
  EXPECT_FLOAT_EQ(cloud.updated[1], 1 / 3.0f);
}

TEST_P(CellWeightsOn, AnIsolatedCellWithoutClutterHoldsOneTarget) {
  WeightedCloud cloud;
  for (int i = 0; i < 1000; ++i) {
    cloud.add(20 + 0.0004f * static_cast<float>(i), 30, 1e-3f, 0.01f * static_cast<float>(i));
  }
  CellWeights::Args args = cloud.args(64, 64);
  args.clutter = 0;
  run(args);
  EXPECT_NEAR(std::accumulate(cloud.updated.begin(), cloud.updated.end(), 0.0), 1, 1e-5);
  EXPECT_NEAR(total_mass(cloud.workspace.runs), 1, 1e-5);
}

TEST_P(CellWeightsOn, AWindowNeverHoldsMoreThanOneTarget) {
  WeightedCloud cloud = random_cloud(3000, 30, 20);
  run(cloud.args(30, 20, 1));
  const CellRuns& runs = cloud.workspace.runs;
  for (const float mass : runs.mass) EXPECT_LE(mass, 1);
  const double sum = std::accumulate(cloud.updated.begin(), cloud.updated.end(), 0.0);
  EXPECT_NEAR(total_mass(runs), sum, 1e-4 * sum);
  for (std::size_t r = 0; r < runs.size(); ++r) {
    double mass = 0;
    for (std::uint32_t k = runs.first[r]; k < runs.first[r + 1]; ++k) {
      mass += cloud.updated[runs.order[k]];
    }
    EXPECT_NEAR(runs.mass[r], mass, 1e-5);
  }
}

TEST_P(CellWeightsOn, PermutedParticlesGetPermutedWeights) {
  WeightedCloud cloud = random_cloud(6000, 50, 40), shuffled;
  std::vector<std::uint32_t> permutation(6000);
  for (std::uint32_t i = 0; i < 6000; ++i) permutation[i] = i * 7 % 6000;
  for (const std::uint32_t i : permutation) {
    shuffled.add(cloud.x[i], cloud.y[i], cloud.predicted[i], cloud.log_ratio[i]);
  }
  run(cloud.args(50, 40));
  run(shuffled.args(50, 40));
  EXPECT_EQ(cloud.workspace.runs.cell, shuffled.workspace.runs.cell);
  EXPECT_EQ(cloud.workspace.runs.first, shuffled.workspace.runs.first);
  for (std::size_t k = 0; k < permutation.size(); ++k) {
    const float want = cloud.updated[permutation[k]];
    ASSERT_NEAR(shuffled.updated[k], want, 1e-6f * want);
  }
}

TEST_P(CellWeightsOn, OddLogRatiosAreHarmless) {
  WeightedCloud cloud;
  cloud.add(3, 3, 1, -kInfinity);
  cloud.add(3, 3, 1, kNan);
  cloud.add(3, 3, 1, kInfinity);
  cloud.add(kNan, 3, 1, 0);
  cloud.add(3, kInfinity, 1, 0);
  cloud.add(8, 8, 0, 1);
  CellWeights::Args args = cloud.args(10, 10);
  args.clutter = 0;
  run(args);
  EXPECT_EQ(cloud.updated, (std::vector<float>{0, 0, 1, 0, 0, 0}));
}

TEST_P(CellWeightsOn, AcceptNothing) {
  WeightedCloud none, outside;
  run(none.args(8, 8));
  EXPECT_EQ(none.workspace.runs.size(), 0u);
  EXPECT_EQ(none.workspace.runs.first, std::vector<std::uint32_t>{0});
  outside.add(1, 1, 1, 0);
  run(outside.args(0, 0));
  EXPECT_EQ(outside.updated[0], 0);
  EXPECT_EQ(total_mass(outside.workspace.runs), 0);
}

TEST_P(CellWeightsOn, RefuseUnlikeLengths) {
  WeightedCloud cloud = random_cloud(4, 8, 8);
  CellWeights::Args args = cloud.args(8, 8);
  args.y = args.y.first(3);
  EXPECT_THROW(run(args), std::invalid_argument);
  args = cloud.args(8, 65536);
  EXPECT_THROW(run(args), std::invalid_argument);
}

TEST_P(CellWeightsOn, AWarmWorkspaceGivesTheSameAsAFreshOne) {
  WeightedCloud large = random_cloud(9000, 60, 60), small = random_cloud(50, 20, 20), fresh = small;
  run(large.args(60, 60));
  CellWeights::Args args = small.args(20, 20);
  args.workspace = &large.workspace;
  run(args);
  run(fresh.args(20, 20));
  EXPECT_EQ(small.updated, fresh.updated);
  EXPECT_EQ(large.workspace.runs.order, fresh.workspace.runs.order);
  EXPECT_EQ(large.workspace.runs.mass, fresh.workspace.runs.mass);
}

TEST(BoxSums, AddWhatTheWindowHolds) {
  CellRuns runs;
  runs.cell = {0, 2, 7, 19, 20, 39};  // a frame of 10 x 4
  const std::vector<float> values{1, 2, 4, 8, 16, 32};
  std::vector<float> sums(6);
  box_sums(runs, 10, 4, 2, values, sums);
  EXPECT_EQ(sums, (std::vector<float>{19, 19, 12, 44, 19, 40}));
}

}  // namespace
}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
// The steps of an iteration against their formulas, for one target and frames of a single lit cell.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "glint/engine/trackers/h_pmht/hpmht_batch.hpp"

namespace glint {
namespace {

constexpr int kSize = 40;

/// Frames that show `intensity` in the one cell (x, 20), or nothing.
class LitCells {
 public:
  void add(int x, float intensity, double step = 1) {
    Image<float>& image = images_.emplace_back(kSize, kSize);
    image.view()(x, 20) = intensity;
    BatchScan scan;
    scan.frame = image.view();
    scan.total = {intensity, kSize * kSize};
    scan.step = step;
    scans.push_back(scan);
  }
  std::vector<BatchScan> scans;

 private:
  std::vector<Image<float>> images_;
};

HPmhtConfig whole_frame() {
  HPmhtConfig config;
  config.sensor_area = 1e9;
  return config;
}

/// Moves by 1 px a scan along x from (9, 20); R = 2, pi = .25, Q = .5.
BatchTarget mover() {
  BatchTarget t;
  t.prior_x.mean << 9, 1;
  t.prior_y.mean << 20, 0;
  t.prior_x.covariance << 4, 0.5, 0.5, 1;
  t.prior_y.covariance << 9, 0, 0, 2;
  t.origin_x = t.prior_x.mean, t.origin_y = t.prior_y.mean;
  t.noise = 0.5;
  for (std::size_t k = 0; k < t.states.size(); ++k) {
    t.states[k] = {10.0 + static_cast<double>(k), 20, 1, 0, 2, 2, 0.25};
  }
  return t;
}

/// What the smoother makes of the target's measurements where scan t weighs `weights[t]`.
std::vector<AxisBelief> smoothed_x(const BatchTarget& target, const BatchTarget& before,
                                   const std::vector<double>& weights) {
  std::vector<AxisScan> scans;
  for (std::size_t t = 0; t < weights.size(); ++t) {
    AxisScan scan{1, before.noise / weights[t]};
    const BatchState& s = target.states[t];
    if (s.count > 0) scan.position = s.mean_x, scan.variance = before.states[t].var_x / s.count;
    scans.push_back(scan);
  }
  std::vector<AxisBelief> beliefs(weights.size() + 1);
  smooth_constant_velocity({before.prior_x.mean, before.prior_x.covariance / weights[0]}, scans,
                           beliefs);
  return beliefs;
}

TEST(HPmhtBatchSteps, MotionWeighsAsTheScansShots) {
  LitCells cells;
  cells.add(10, 100), cells.add(12, 50), cells.add(12, 300);
  std::vector<BatchTarget> targets{mover()};
  HPmhtBatch(whole_frame(), Device::serial()).iterate(cells.scans, targets);
  const auto expected = smoothed_x(targets[0], mover(), {100, 50, 300});
  for (std::size_t t = 0; t < 3; ++t) {
    EXPECT_NEAR(targets[0].states[t].x, expected[t + 1].mean(0), 1e-4) << t;
    EXPECT_NEAR(targets[0].states[t].vx, expected[t + 1].mean(1), 1e-4) << t;
  }
  EXPECT_NEAR(targets[0].origin_x(0), expected[0].mean(0), 1e-4);
}

TEST(HPmhtBatchSteps, AScanThatShowsNothingWeighsAsTheOthersOnAverage) {
  LitCells cells;
  cells.add(10, 100), cells.add(0, 0), cells.add(14, 300);
  std::vector<BatchTarget> targets{mover()};
  HPmhtBatch(whole_frame(), Device::serial()).iterate(cells.scans, targets);
  const auto expected = smoothed_x(targets[0], mover(), {100, 200, 300});
  const auto of_the_sum = smoothed_x(targets[0], mover(), {100, 400, 300});
  ASSERT_GT(std::abs(of_the_sum[2].mean(0) - expected[2].mean(0)), 1e-2);
  for (std::size_t t = 0; t < 3; ++t) {
    EXPECT_NEAR(targets[0].states[t].x, expected[t + 1].mean(0), 1e-4) << t;
  }
}

TEST(HPmhtBatchSteps, MotionWeighsAsTheShotsOfTheSensorArea) {
  LitCells cells;
  cells.add(10, 100), cells.add(13, 100);
  HPmhtConfig config;
  config.sensor_area = kSize * kSize / 20.0;
  std::vector<BatchTarget> targets{mover()};
  HPmhtBatch(config, Device::serial()).iterate(cells.scans, targets);
  const auto expected = smoothed_x(targets[0], mover(), {5, 5});
  EXPECT_NEAR(targets[0].states[1].x, expected[2].mean(0), 1e-4);
}

// (11) of a lit cell is its conditional mean, here the cell's own centre on the axis across.
TEST(HPmhtBatchSteps, ATargetsShareOfALitCellIsItsPosterior) {
  LitCells cells;
  cells.add(10, 100);
  std::vector<BatchTarget> targets{mover()};
  HPmhtBatch(whole_frame(), Device::serial()).iterate(cells.scans, targets);
  const double side = std::erf(0.5 / std::sqrt(2 * 2.0));  // of N(0, 2) on the cell, an axis
  const double own = 0.25 * side * side, flat = 0.75 / (kSize * kSize);
  const BatchState& s = targets[0].states[0];
  EXPECT_NEAR(s.count, 100 * own / (own + flat), 1e-3);
  EXPECT_NEAR(s.mean_x, 10, 1e-6);
  EXPECT_NEAR(s.mean_y, 20, 1e-6);
  EXPECT_NEAR(s.proportion, own / (own + flat), 1e-5);  // (14): all of Z lies in the cell
}

// (18) about the new state. A density that hardly changes over the cell has the variance 1/12
// there.
TEST(HPmhtBatchSteps, TheExtentIsTakenAboutTheNewState) {
  LitCells cells;
  cells.add(13, 100);
  HPmhtConfig config = whole_frame();
  config.estimate_extent = true, config.extent_low = 1e-3;
  std::vector<BatchTarget> targets{mover()};
  HPmhtBatch(config, Device::serial()).iterate(cells.scans, targets);
  const BatchState& s = targets[0].states[0];
  ASSERT_GT(13 - s.x, 0.5);
  const double off = s.mean_x - s.x;
  EXPECT_NEAR(s.var_x, 1.0 / 12 + off * off, 0.02);
  EXPECT_NEAR(s.var_y, 1.0 / 12, 0.01);
}

// (19): the mean of e' Q^-1 e over axes, states and scans, with Q^-1 = [[12, -6], [-6, 4]].
TEST(HPmhtBatchSteps, TheNoiseIsTheMeanSquareOfWhatTheMotionLeaves) {
  LitCells cells;
  cells.add(10, 100), cells.add(14, 300);
  HPmhtConfig config = whole_frame();
  config.estimate_process = true, config.process_noise = 0.01;
  std::vector<BatchTarget> targets{mover()};
  HPmhtBatch(config, Device::serial()).iterate(cells.scans, targets);
  const BatchTarget& t = targets[0];
  double sum = 0;
  Eigen::Vector2d last = t.origin_x;
  for (const std::size_t k : {0, 1}) {
    const BatchState& s = t.states[k];
    const double p = s.x - last(0) - last(1), v = s.vx - last(1);
    sum += (k == 0 ? 100 : 300) * (12 * p * p - 12 * p * v + 4 * v * v);
    last << s.x, s.vx;
  }
  const double expected = sum / (4 * 400);
  ASSERT_GT(expected, 0.001);  // within the limits
  ASSERT_LT(expected, 0.1);
  EXPECT_NEAR(t.noise, expected, 1e-3 * expected);
}

TEST(HPmhtBatchSteps, RunEndsWhenNothingMoves) {
  HPmhtConfig config = whole_frame();
  config.iterations = 9;
  LitCells dark, lit;
  dark.add(0, 0), dark.add(0, 0);
  std::vector<BatchTarget> still{mover()}, moving{mover()};
  EXPECT_EQ(HPmhtBatch(config, Device::serial()).run(dark.scans, still), 1);
  lit.add(13, 100), lit.add(8, 100);
  config.iterations = 3;
  EXPECT_EQ(HPmhtBatch(config, Device::serial()).run(lit.scans, moving), 3);
}

/// The Kalman update of `prior`, moved on by one scan of noise q, by z with variance r.
AxisBelief updated(const AxisBelief& prior, double q, double z, double r) {
  Eigen::Matrix2d f, noise;
  f << 1, 1, 0, 1;
  noise << q / 3, q / 2, q / 2, q;
  const Eigen::Vector2d mean = f * prior.mean;
  const Eigen::Matrix2d p = f * prior.covariance * f.transpose() + noise;
  const Eigen::Vector2d gain = p.col(0) / (p(0, 0) + r);
  return {mean + gain * (z - mean(0)), p - gain * p.row(0)};
}

// What a target knows is counted in shots, so a share of them that the target explains of R each.
TEST(HPmhtBatchSteps, SlidingMakesTheFirstScanThePriorOnBothAxes) {
  LitCells cells;
  cells.add(11, 100), cells.add(12, 300);
  HPmhtBatch batch(whole_frame(), Device::serial());
  std::vector<BatchTarget> targets{mover(), mover()};
  targets[1].first = 1;
  batch.iterate(cells.scans, targets);
  const BatchTarget before = targets[0], later = targets[1];
  batch.slide(cells.scans, targets);
  const BatchState& s = before.states[0];
  const double r = 2 / (s.count / 100);
  const AxisBelief x = updated(before.prior_x, 0.5, s.mean_x, r);
  const AxisBelief y = updated(before.prior_y, 0.5, s.mean_y, r);
  EXPECT_LT((targets[0].prior_x.mean - x.mean).norm(), 1e-4);
  EXPECT_LT((targets[0].prior_y.mean - y.mean).norm(), 1e-4);
  EXPECT_LT((targets[0].prior_x.covariance - x.covariance).norm(), 1e-3);
  EXPECT_LT((targets[0].prior_y.covariance - y.covariance).norm(), 1e-3);
  EXPECT_EQ(targets[0].states[0].x, before.states[1].x);
  // One that began at the second scan now begins at the first, with the prior that it had.
  EXPECT_EQ(targets[1].first, 0u);
  EXPECT_EQ(targets[1].prior_x.covariance, later.prior_x.covariance);
  EXPECT_EQ(targets[1].states[0].x, later.states[1].x);
}

}  // namespace
}  // namespace glint

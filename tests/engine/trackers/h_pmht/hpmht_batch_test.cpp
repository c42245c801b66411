// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/h_pmht/hpmht_batch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "glint/engine/scenario/scenario.hpp"

namespace glint {
namespace {

constexpr int kScans = 6;

struct Movie {
  std::vector<Image<float>> frames;
  std::vector<BatchScan> scans;
};

/// Scans of a scene, as h-pmht sees Gaussian noise: what exceeds one sigma. All of it times
/// `factor`.
Movie film(const Scene& scene, float factor = 1) {
  Movie movie;
  for (int t = 0; t < scene.frames; ++t) {
    Image<float>& image = movie.frames.emplace_back(render(scene, 7, t));
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        float& pixel = image.view()(x, y);
        pixel = std::round(pixel * 256) / 256 * factor;  // exact for small whole factors
      }
    }
  }
  for (const Image<float>& image : movie.frames) {
    BatchScan scan;
    scan.frame = image.view();
    scan.rule = {.threshold = factor, .subtract = true};
    SumCells::serial({scan.frame, scan.rule, &scan.total});
    movie.scans.push_back(scan);
  }
  return movie;
}

ScriptedTarget straight(const Kinematics& start, double intensity = 25) {
  ScriptedTarget t;
  t.birth = 0, t.death = 1000, t.intensity = intensity, t.path = fly(start);
  return t;
}

Scene batch_scene(std::vector<ScriptedTarget> targets, double noise = 1) {
  Scene s;
  s.width = 50, s.height = 40, s.frames = kScans, s.noise_sigma = noise;
  s.point_spread = PointSpread::of(1);
  s.targets = std::move(targets);
  return s;
}

/// A target that is believed to be at `at` one step before the first scan, and to go on from there.
BatchTarget guess(const Kinematics& at) {
  BatchTarget t;
  t.prior_x.mean << at.x, at.vx;
  t.prior_y.mean << at.y, at.vy;
  t.prior_x.covariance << 9, 0, 0, 1;
  t.prior_y.covariance = t.prior_x.covariance;
  t.origin_x = t.prior_x.mean, t.origin_y = t.prior_y.mean;
  t.noise = 0.1;
  for (int k = 0; k < kScans; ++k) {
    BatchState& s = t.states[static_cast<std::size_t>(k)];
    s = {at.x + (k + 1) * at.vx, at.y + (k + 1) * at.vy, at.vx, at.vy, 2, 2, 0.1, 0};
  }
  return t;
}

/// Motion counts as often as the shots of the whole frame, as in the paper.
HPmhtConfig paper_weights() {
  HPmhtConfig config;
  config.iterations = 8;
  config.sensor_area = 1e9;
  return config;
}

std::vector<BatchTarget> two_guesses() {
  return {guess({7, 12, 2.5, 0.5}), guess({38, 27, -1.5, 0})};
}

Scene two_targets() {
  return batch_scene({straight({9, 11, 2.2, 0.8}), straight({37, 28, -1.8, -0.3})});
}

TEST(HPmhtBatch, NoIterationLowersTheObjective) {
  const Movie movie = film(two_targets());
  for (const bool extent : {false, true}) {
    HPmhtConfig config = paper_weights();
    config.estimate_extent = extent;
    HPmhtBatch batch(config, Device::serial());
    std::vector<BatchTarget> targets = two_guesses();
    double last = batch.objective(movie.scans, targets);
    const double start = last;
    for (int i = 0; i < 30; ++i) {
      batch.iterate(movie.scans, targets);
      const double now = batch.objective(movie.scans, targets);
      EXPECT_GE(now, last - 1e-6 * std::abs(last)) << "iteration " << i;
      last = now;
    }
    EXPECT_GT(last, start + 10);
  }
}

TEST(HPmhtBatch, AFactorOfAllIntensitiesChangesNothing) {
  const Movie one = film(two_targets()), many = film(two_targets(), 37);
  for (const bool estimate : {false, true}) {
    HPmhtConfig config = paper_weights();
    config.estimate_extent = config.estimate_process = estimate;
    config.process_noise = 0.1;
    HPmhtBatch batch(config, Device::serial());
    std::vector<BatchTarget> a = two_guesses(), b = two_guesses();
    for (int i = 0; i < 8; ++i) {
      batch.iterate(one.scans, a);
      batch.iterate(many.scans, b);
    }
    for (std::size_t k = 0; k < a.size(); ++k) {
      for (std::size_t t = 0; t < kScans; ++t) {
        EXPECT_NEAR(a[k].states[t].x, b[k].states[t].x, 1e-10);
        EXPECT_NEAR(a[k].states[t].vy, b[k].states[t].vy, 1e-10);
        EXPECT_NEAR(a[k].states[t].count * 37, b[k].states[t].count, 1e-8);
      }
    }
  }
}

TEST(HPmhtBatch, FindsBothTargetsFromAWrongGuess) {
  const Movie movie = film(two_targets());
  HPmhtConfig config;
  config.sensor_area = 100, config.iterations = 20;
  HPmhtBatch batch(config, Device::tbb(1));
  std::vector<BatchTarget> targets = two_guesses();
  batch.run(movie.scans, targets);
  for (int t = 0; t < kScans; ++t) {
    const auto at = static_cast<std::size_t>(t);
    EXPECT_NEAR(targets[0].states[at].x, 9 + 2.2 * t, 1) << t;
    EXPECT_NEAR(targets[0].states[at].y, 11 + 0.8 * t, 1) << t;
    EXPECT_NEAR(targets[1].states[at].x, 37 - 1.8 * t, 1) << t;
    EXPECT_NEAR(targets[1].states[at].y, 28 - 0.3 * t, 1) << t;
  }
}

TEST(HPmhtBatch, MixingProportionsAreTheCountsShares) {
  const Movie movie = film(two_targets());
  HPmhtBatch batch(paper_weights(), Device::serial());
  std::vector<BatchTarget> targets = two_guesses();
  batch.iterate(movie.scans, targets);
  const BatchState& s = targets[0].states[2];
  EXPECT_NEAR(s.proportion, s.count / movie.scans[2].total.norm, 1e-9);
}

TEST(HPmhtBatch, LearnsTheExtentOfATarget) {
  Scene scene = batch_scene({straight({25, 20, 0, 0}, 4000)}, 0);
  scene.point_spread = PointSpread::of(2.5);
  Movie movie = film(scene);
  for (BatchScan& scan : movie.scans) {
    scan.rule.threshold = 0;
    SumCells::serial({scan.frame, scan.rule, &scan.total});
  }
  HPmhtConfig config = paper_weights();
  config.estimate_extent = true, config.iterations = 20;
  std::vector<BatchTarget> targets{guess({23, 21, 0, 0})};
  HPmhtBatch(config, Device::serial()).run(movie.scans, targets);
  EXPECT_NEAR(targets[0].states[3].var_x, 2.5 * 2.5, 0.4);
  EXPECT_NEAR(targets[0].states[3].x, 25, 0.15);
  config.extent_high = 4;
  HPmhtBatch(config, Device::serial()).run(movie.scans, targets);
  EXPECT_EQ(targets[0].states[3].var_x, 4);
}

TEST(HPmhtBatch, LearnsNoiseFromATenthToTenTimesTheSetting) {
  const Movie movie = film(two_targets());
  for (const double setting : {1e-9, 1e3}) {
    HPmhtConfig config = paper_weights();
    config.estimate_process = true, config.process_noise = setting;
    HPmhtBatch batch(config, Device::serial());
    std::vector<BatchTarget> targets = two_guesses();
    batch.iterate(movie.scans, targets);
    for (const BatchTarget& t : targets) {
      EXPECT_DOUBLE_EQ(t.noise, setting * (setting < 1 ? 10 : 0.1));
    }
  }
}

TEST(HPmhtBatch, CoastsThroughAScanThatShowsNothing) {
  Movie movie = film(batch_scene({straight({9, 11, 2.2, 0.8})}));
  Image<float> dark(50, 40);
  movie.scans[3].frame = dark.view();
  movie.scans[3].total = {0, 2000};
  std::vector<BatchTarget> targets{guess({7, 11, 2, 0.7})};
  HPmhtConfig config;
  config.sensor_area = 100, config.iterations = 20;
  HPmhtBatch(config, Device::serial()).run(movie.scans, targets);
  EXPECT_NEAR(targets[0].states[3].x, 9 + 2.2 * 3, 0.7);
  EXPECT_NEAR(targets[0].states[5].x, 9 + 2.2 * 5, 0.7);
  EXPECT_EQ(targets[0].states[3].count, 0);
}

TEST(HPmhtBatch, NothingShownAtAllMovesTheGuessOnByItself) {
  Movie movie;
  const Image<float> dark(50, 40);
  BatchScan scan;
  scan.frame = dark.view(), scan.total = {0, 2000};
  movie.scans.assign(kScans, scan);
  std::vector<BatchTarget> targets{guess({7, 11, 2, 0.7})};
  HPmhtBatch(paper_weights(), Device::serial()).run(movie.scans, targets);
  EXPECT_NEAR(targets[0].states[5].x, 7 + 6 * 2, 1e-9);
  EXPECT_NEAR(targets[0].states[5].vy, 0.7, 1e-9);
}

TEST(HPmhtBatch, IgnoresScansBeforeATargetsFirst) {
  const Movie movie = film(two_targets());
  std::vector<BatchTarget> late{guess({7 + 2 * 2.2, 11 + 2 * 0.8, 2.2, 0.8})};
  late[0].first = 3;
  const BatchState untouched = late[0].states[1];
  HPmhtBatch(paper_weights(), Device::serial()).run(movie.scans, late);
  EXPECT_EQ(late[0].states[1].x, untouched.x);
  EXPECT_EQ(late[0].states[1].count, 0);
}

}  // namespace
}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/pmht/mmpf_pmht.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "glint/engine/trackers/pmht/kalman_bank.hpp"

namespace glint {
namespace {

constexpr double kBankVariance = 9;

Imm bank(const char* motion = "ca+singer") {
  PmhtConfig config;
  config.motion = motion;
  return pmht_bank(config, {{100, 50}, {4, -2}, 1});
}

ParticleBank particles(int count, std::uint64_t seed = 1, const char* motion = "ca+singer") {
  return {bank(motion), count, kBankVariance, seed, 1};
}

std::vector<PmhtCentroid> seen_at(double x, double y, std::size_t models = 2) {
  return std::vector<PmhtCentroid>(models, PmhtCentroid{0.9, {x, y}});
}

TEST(ParticleBank, ManyParticlesPredictAsKalmanFilters) {
  KalmanBank exact(bank(), kBankVariance);
  ParticleBank cloud = particles(40000);
  exact.predict(1), cloud.predict(1);
  const Gaussian<4> a = exact.state(), b = cloud.state();
  EXPECT_LT((a.mean - b.mean).norm(), 0.15);
  EXPECT_LT((a.covariance - b.covariance).norm(), 0.03 * a.covariance.norm());
  EXPECT_NEAR(cloud.mode(0).position.x(), exact.mode(0).position.x(), 0.1);
  EXPECT_EQ(cloud.mode(1).probability, 0.5);
}

TEST(ParticleBank, ManyParticlesAreUpdatedAsOneKalmanFilter) {
  KalmanBank exact(bank("ca"), kBankVariance);
  ParticleBank cloud = particles(40000, 1, "ca");
  exact.predict(1), cloud.predict(1);
  const std::vector<PmhtCentroid> whole(1, PmhtCentroid{1, {108, 45}});  // R / W is R
  EXPECT_LT((exact.maximise(0, whole[0]) - cloud.maximise(0, whole[0])).norm(), 0.15);
  exact.update(whole, whole), cloud.update(whole, whole);
  const Gaussian<4> a = exact.state(), b = cloud.state();
  EXPECT_LT((a.mean - b.mean).norm(), 0.2);
  EXPECT_LT((a.covariance - b.covariance).norm(), 0.05 * a.covariance.norm());
}

TEST(ParticleBank, IsTheSameFarFromTheOrigin) {
  // Whole cells of its grid away (of 16384 standard deviations of a point), so that the particles
  // are the same; the target then crosses into the next cell.
  const Eigen::Vector2d far = 3 * 16384 * Eigen::Vector2d(1000, -700);
  const auto run = [](const Eigen::Vector2d& origin) {
    PmhtConfig config;
    ParticleBank cloud(pmht_bank(config, {origin + Eigen::Vector2d(24570, 50), {4, -2}, 1}), 100,
                       kBankVariance, 1, 1);
    Eigen::Vector2d maximum;
    for (int scan = 1; scan < 6; ++scan) {
      cloud.predict(1);
      const auto seen = seen_at(origin.x() + 24570 + 4 * scan, origin.y() + 50 - 2 * scan);
      maximum = cloud.maximise(0, seen[0]) - origin;
      cloud.update(seen, seen);
    }
    const Eigen::Vector4d state = cloud.state().mean;
    return Eigen::Vector4d(state(0) - origin.x(), state(2) - origin.y(), maximum.x(), maximum.y());
  };
  const Eigen::Vector4d near = run({0, 0});
  EXPECT_LT((near - Eigen::Vector4d(24590, 40, 24590, 40)).norm(), 15);
  EXPECT_LT((run(far) - near).norm(), 1e-6);
}

TEST(ParticleBank, LikelihoodIsTheMeanOverTheParticlesOfThePrediction) {
  ParticleBank cloud = particles(40000);
  cloud.predict(1);
  // Two models alike but for their process noise, which is far below that of the start.
  cloud.update(seen_at(104, 48), seen_at(104, 48));
  EXPECT_NEAR(cloud.probability()[0], 0.5, 0.03);
  EXPECT_NEAR(cloud.probability()[0] + cloud.probability()[1], 1, 1e-12);
}

TEST(ParticleBank, WithoutPointsNothingChanges) {
  ParticleBank cloud = particles(100);
  cloud.predict(1);
  const Gaussian<4> before = cloud.state();
  const std::vector<PmhtCentroid> none(2);
  cloud.update(none, none);
  EXPECT_EQ(cloud.state().mean, before.mean);
  EXPECT_EQ(cloud.probability()[0], 0.5);
}

TEST(ParticleBank, CollapsedCloudsAreDrawnAnewAndModelsAreEquallyLikely) {
  ParticleBank cloud = particles(200);
  for (int scan = 0; scan < 6; ++scan) {  // clouds narrow
    cloud.predict(1);
    cloud.update(seen_at(104 + 4 * scan, 48 - 2 * scan), seen_at(104 + 4 * scan, 48 - 2 * scan));
  }
  cloud.predict(1);
  const Gaussian<4> before = cloud.state();
  cloud.update(seen_at(500, 500), seen_at(500, 500));
  EXPECT_LT((cloud.state().mean - before.mean).norm(), 5);  // the centroid tells nothing
  EXPECT_NEAR(cloud.probability()[0], 0.5, 1e-12);
  cloud.predict(1);
  EXPECT_TRUE(cloud.state().mean.allFinite());
  EXPECT_GT(cloud.state().covariance(0, 0), 0);
}

TEST(ParticleBank, IsAFunctionOfSeedAndTrack) {
  const auto run = [](std::uint64_t seed, std::int64_t track) {
    ParticleBank cloud(bank(), 50, kBankVariance, seed, track);
    cloud.predict(1);
    cloud.update(seen_at(104, 48), seen_at(104, 48));
    return cloud.state().mean;
  };
  EXPECT_EQ(run(3, 1), run(3, 1));
  EXPECT_NE(run(3, 1), run(4, 1));
  EXPECT_NE(run(3, 1), run(3, 2));
}

TEST(MmpfPmht, FollowsATargetThatItIsStartedOn) {
  MmpfPmhtConfig config;
  config.initiate = false, config.clutter_density = 1e-4;
  EXPECT_EQ(config.particles, 200);
  MmpfPmht tracker(config, Device::serial(), 1);
  TrackLog log;
  tracker.start(20, 50, 3, 1);
  for (int frame = 0; frame < 30; ++frame) {
    const std::vector<PointMeasurement> points{
        {20 + 3 * static_cast<double>(frame), 50 + static_cast<double>(frame), 8}};
    Scan scan;
    scan.frame = frame, scan.time = frame, scan.points = points;
    tracker.step(scan, log);
    ASSERT_EQ(log.at(frame).size(), 1u);
    EXPECT_LT(std::hypot(log.at(frame)[0].x - 20 - 3 * frame, log.at(frame)[0].y - 50 - frame), 4);
  }
}

}  // namespace
}  // namespace glint

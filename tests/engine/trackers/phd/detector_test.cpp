// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/detector.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "engine/trackers/phd/few_particles.hpp"

namespace glint {
namespace {

using namespace test;

/// Births lie around the pixels above 1; targets are so dim that l = 1 within a thousandth.
DetectorConfig exact_detector() {
  DetectorConfig c;
  static_cast<AppearanceConfig&>(c) = exact_appearance(1 + 1e-6);
  static_cast<MotionConfig&>(c) = exact_motion();
  c.speed_max = 0.01;
  c.birth = BirthProposal::uniform, c.birth_particles = 3000, c.birth_mass = 3,
  c.birth_threshold = 1;
  return c;
}

class Search {
 public:
  explicit Search(const DetectorConfig& config, WeightSum sum = WeightSum::expected_targets)
      : detector(config, Device::serial(), 1, sum) {
    detector.set_appearance(ready(config));
  }
  void update(const std::vector<Pixel>& bright, std::vector<FollowedTarget> followed = {}) {
    Image<float> image(kSide, kSide);
    for (const Pixel& p : bright) image.view()(p.x, p.y) = 1.001F;
    detector.update(Frame(std::move(image)), {++frame_, 0, 1, 1}, followed);
  }
  void resample() { detector.resample(frame_); }
  Detector detector;

 private:
  std::int64_t frame_ = 0;
};

FollowedTarget target_at(double x, double y) {
  FollowedTarget target;
  target.estimate.x = x, target.estimate.y = y;
  return target;
}

/// The mass of particles in one window is m / (1 + m), P-PHD (14) at l = 1.
double shared(double mass) { return mass / (1 + mass); }

TEST(Detector, FindsAClusterAtEachTarget) {
  Search s(exact_detector());
  s.update({{8, 10}, {30, 25}});
  EXPECT_NEAR(s.detector.expected(), 2 * shared(1.5), 0.02);
  const auto found = s.detector.find(0.5);
  ASSERT_EQ(found.size(), 2U);
  const Cluster& first = found[0].peak.x < 20 ? found[0] : found[1];
  EXPECT_NEAR(first.peak.x, 8, 0.1);
  EXPECT_NEAR(first.peak.y, 10, 0.1);
  EXPECT_NEAR(first.peak.mass, shared(1.5), 0.02);
  double mass = 0;
  for (const auto i : first.members) {
    ASSERT_NEAR(first.particles.x[i], 8, 1.51);
    mass += first.particles.weight[i];
  }
  EXPECT_NEAR(mass, first.peak.mass, 1e-4);
  EXPECT_TRUE(s.detector.find(0.8).empty());
}

// Births fill 3x3 pixels; a box of 2 x .6 px a side holds 1.44 of their 9.
TEST(Detector, TakesTheRadiusOfAClusterFromTheSettings) {
  DetectorConfig config = exact_detector();
  config.cluster_radius = 0.6;
  Search s(config);
  s.update({{8, 10}});
  const auto found = s.detector.find(0.05);
  ASSERT_FALSE(found.empty());
  EXPECT_NEAR(found[0].peak.mass, shared(3) * 1.44 / 9, 0.02);
}

TEST(Detector, RemovesAClusterAndNoOther) {
  Search s(exact_detector());
  s.update({{8, 10}, {30, 25}});
  const double all = s.detector.expected();
  const Cluster& gone = s.detector.find(0.5).front();
  const double x = gone.peak.x, mass = gone.peak.mass;
  s.detector.remove(gone);
  EXPECT_NEAR(s.detector.expected(), all - mass, 1e-4);
  s.resample();
  s.update({});
  const auto left = s.detector.find(0.3);
  ASSERT_EQ(left.size(), 1U);
  EXPECT_GT(std::abs(left[0].peak.x - x), 20);
}

// P-PHD (36): nothing is born at a target that is followed, and nothing lives there.
TEST(Detector, IsBlindAroundTargetsThatAreFollowed) {
  Search s(exact_detector());
  s.update({{8, 10}, {30, 25}}, {target_at(9.3, 11.2)});
  const auto found = s.detector.find(0.3);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].peak.x, 30, 0.1);
  EXPECT_NEAR(found[0].peak.mass, shared(3), 0.02);  // all births are there
  s.resample();
  s.update({}, {target_at(30, 25)});
  EXPECT_TRUE(s.detector.find(1e-6).empty());
}

/// The pixels [first, last] along x in which particles at y = 20 keep no weight.
std::pair<int, int> masked_columns(double mask_half_width, double target_x) {
  DetectorConfig config = exact_detector();
  config.mask_half_width = mask_half_width;
  Search s(config);
  std::vector<Pixel> row;
  for (int x = 2; x < kSide - 2; ++x) row.push_back({x, 20});
  s.update(row);
  s.resample();
  s.update({}, {target_at(target_x, 20.2)});
  const auto found = s.detector.find(1e-9);
  EXPECT_FALSE(found.empty());
  const Particles& p = found[0].particles;
  int first = kSide, last = -1;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.weight[i] > 0) continue;
    const int column = static_cast<int>(std::floor(p.x[i] + 0.5F));
    first = std::min(first, column), last = std::max(last, column);
  }
  return {first, last};
}

TEST(Detector, MasksABoxAroundThePixelThatHoldsTheTarget) {
  EXPECT_EQ(masked_columns(5, 20.4), (std::pair{15, 25}));
  EXPECT_EQ(masked_columns(5, 20.6), (std::pair{16, 26}));
  EXPECT_EQ(masked_columns(0, 20.4), (std::pair{18, 22}));  // auto: half the window
}

TEST(Detector, OfOddsHasPeaksWithoutSharing) {
  Search s(exact_detector(), WeightSum::odds);
  s.update({{8, 10}, {30, 25}});
  const auto found = s.detector.find(1);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0].peak.mass + found[1].peak.mass, 3, 0.01);
}

}  // namespace
}  // namespace glint

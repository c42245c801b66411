// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/adaptive_noise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/trackers/phd/few_particles.hpp"

namespace glint {
namespace {

using namespace test;

constexpr double kRange = 50;

/// Clusters of one particle each, with the label and the determinant of the position covariance.
struct Clusters {
  struct Item {
    std::uint32_t label;
    double determinant;
  };
  explicit Clusters(const std::vector<Item>& items) {
    std::vector<TestParticle> list;
    for (const Item& item : items) {
      Peak peak;
      // det [[2, 1], [1, v]] = 2 v - 1
      peak.var_x = 2, peak.cov_xy = 1, peak.var_y = (item.determinant + 1) / 2;
      peak.first = list.size(), peak.last = peak.first + 1;
      peaks.push_back(peak);
      list.push_back({.label = item.label});
    }
    particles = particles_of(list);
    members = all_members(particles);
  }
  std::vector<Peak> peaks;
  Particles particles;
  std::vector<std::uint32_t> members;
};

void update(AdaptiveNoise& noise, const std::vector<Clusters::Item>& items) {
  const Clusters clusters(items);
  noise.update(clusters.peaks, clusters.members, clusters.particles);
}

/// Q / Qmin of the label.
double noise_of(AdaptiveNoise& noise, std::uint32_t label) {
  const std::vector<std::uint32_t> labels{label};
  const double scale = noise.scales(labels)[0];
  return scale * scale;
}

TEST(AdaptiveNoise, OfANewTargetIsTheLeast) {
  AdaptiveNoise noise(kRange);
  update(noise, {{3, 1}});
  EXPECT_NEAR(noise_of(noise, 3), 1, 1e-6);
  EXPECT_NEAR(noise_of(noise, 8), 1, 1e-6);  // of no label either
}

// P-PHD (21), second line: Q = Qmax + (Q - Qmax) exp(1 - |P'| / |P|) for |P| < |P'|.
TEST(AdaptiveNoise, RisesAsTheParticlesContract) {
  AdaptiveNoise noise(kRange);
  update(noise, {{3, 2}});
  update(noise, {{3, 1}});
  const double once = kRange + (1 - kRange) * std::exp(1 - 2.0 / 1);
  EXPECT_NEAR(noise_of(noise, 3), once, 1e-4);
  update(noise, {{3, 0.5}});
  EXPECT_NEAR(noise_of(noise, 3), kRange + (once - kRange) * std::exp(1 - 1 / 0.5), 1e-4);
}

// P-PHD (21), first line: Q = Qmin + (Q - Qmin) exp(1 - |P| / |P'|) for |P| >= |P'|.
TEST(AdaptiveNoise, FallsAsTheParticlesSpread) {
  AdaptiveNoise noise(kRange);
  update(noise, {{3, 2}});
  update(noise, {{3, 1}});
  const double high = noise_of(noise, 3);
  update(noise, {{3, 3}});
  EXPECT_NEAR(noise_of(noise, 3), 1 + (high - 1) * std::exp(1 - 3.0 / 1), 1e-4);
}

TEST(AdaptiveNoise, StaysAtASingularCovariance) {
  AdaptiveNoise noise(kRange);
  update(noise, {{3, 2}});
  update(noise, {{3, 1}});
  const double high = noise_of(noise, 3);
  update(noise, {{3, 0}});
  EXPECT_NEAR(noise_of(noise, 3), high, 1e-6);
  update(noise, {{3, 1}});  // from a singular one, too
  EXPECT_NEAR(noise_of(noise, 3), high, 1e-6);
}

TEST(AdaptiveNoise, IsEachTargetsOwnAndGoesWithIt) {
  AdaptiveNoise noise(kRange);
  update(noise, {{9, 2}, {4, 2}, {0, 2}});
  update(noise, {{9, 2}, {4, 1}, {0, 1}});
  EXPECT_NEAR(noise_of(noise, 9), 1, 1e-6);
  EXPECT_GT(noise_of(noise, 4), 2);
  EXPECT_NEAR(noise_of(noise, 0), 1, 1e-6);  // particles without a label
  update(noise, {{9, 2}});
  update(noise, {{4, 1}});
  EXPECT_NEAR(noise_of(noise, 4), 1, 1e-6);
}

TEST(AdaptiveNoise, OfARangeOfOneIsFixed) {
  AdaptiveNoise noise(1);
  EXPECT_TRUE(noise.fixed());
  update(noise, {{3, 2}});
  update(noise, {{3, 1}});
  const std::vector<std::uint32_t> labels{3};
  EXPECT_TRUE(noise.scales(labels).empty());
  EXPECT_FALSE(AdaptiveNoise(1.5).fixed());
}

}  // namespace
}  // namespace glint

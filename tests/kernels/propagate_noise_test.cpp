// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/propagate/propagate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "propagate_cases.hpp"

namespace glint::test {
namespace {

using PropagateNoise = PropagateOn;
INSTANTIATE_TEST_SUITE_P(Devices, PropagateNoise,
                         testing::Values(DeviceKind::serial, DeviceKind::tbb),
                         [](const auto& instance) { return std::string(name(instance.param)); });

/// Sample covariance of what `args` adds to equal particles, over the arrays given.
std::vector<std::vector<double>> covariance(const std::vector<AlignedVector<float>*>& arrays) {
  const std::size_t k = arrays.size(), n = arrays[0]->size();
  std::vector<double> mean(k, 0);
  std::vector<std::vector<double>> sum(k, std::vector<double>(k, 0));
  for (std::size_t a = 0; a < k; ++a) {
    for (const float v : *arrays[a]) mean[a] += v / static_cast<double>(n);
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t a = 0; a < k; ++a) {
      for (std::size_t b = 0; b < k; ++b) {
        sum[a][b] += ((*arrays[a])[i] - mean[a]) * ((*arrays[b])[i] - mean[b]);
      }
    }
  }
  for (auto& row : sum) {
    for (double& v : row) v /= static_cast<double>(n);
  }
  return sum;
}

void expect_covariance(const std::vector<std::vector<double>>& got,
                       const std::vector<std::vector<double>>& want, std::size_t n) {
  for (std::size_t a = 0; a < want.size(); ++a) {
    for (std::size_t b = 0; b < want.size(); ++b) {
      const double spread =
          std::sqrt((want[a][a] * want[b][b] + want[a][b] * want[a][b]) / static_cast<double>(n));
      EXPECT_NEAR(got[a][b], want[a][b], 5 * spread) << a << "," << b;
    }
  }
}

TEST_P(PropagateNoise, NoiseOfConstantVelocityHasTheCovarianceQ) {
  Particles p = same(kSamples);
  const MotionMode mode{Motion::constant_velocity, 0, 2};
  Propagate::Args args = args_of(p, std::span(&mode, 1));
  args.step = 1.5f;
  args.intensity_noise = 0.1f;
  args.intensity_low = 0, args.intensity_high = 100;
  device_.run<Propagate>(args);
  const double t = 1.5, q = 2, xx = q * t * t * t / 3, xv = q * t * t / 2, vv = q * t;
  expect_covariance(covariance({&p.x, &p.vx, &p.y, &p.vy, &p.intensity}),
                    {{xx, xv, 0, 0, 0},
                     {xv, vv, 0, 0, 0},
                     {0, 0, xx, xv, 0},
                     {0, 0, xv, vv, 0},
                     {0, 0, 0, 0, 0.1f * t}},
                    kSamples);
}

TEST_P(PropagateNoise, NoiseOfConstantAccelerationHasTheCovarianceQ) {
  Particles p = same(kSamples);
  const MotionMode mode{Motion::constant_acceleration, 0, 3};
  Propagate::Args args = args_of(p, std::span(&mode, 1));
  args.step = 0.8f;
  device_.run<Propagate>(args);
  const double t = 0.8f, q = 3;
  const double xx = q * std::pow(t, 5) / 20, xv = q * std::pow(t, 4) / 8;
  const double xa = q * std::pow(t, 3) / 6, vv = q * std::pow(t, 3) / 3;
  const double va = q * t * t / 2, aa = q * t;
  expect_covariance(covariance({&p.x, &p.vx, &p.ax, &p.y, &p.vy, &p.ay}),
                    {{xx, xv, xa, 0, 0, 0},
                     {xv, vv, va, 0, 0, 0},
                     {xa, va, aa, 0, 0, 0},
                     {0, 0, 0, xx, xv, xa},
                     {0, 0, 0, xv, vv, va},
                     {0, 0, 0, xa, va, aa}},
                    kSamples);
}

TEST_P(PropagateNoise, NoiseScaleMultipliesTheDeviation) {
  Particles p = same(200), q = same(200);
  const MotionMode mode{Motion::constant_velocity, 0, 1};
  Propagate::Args args = args_of(p, std::span(&mode, 1));
  device_.run<Propagate>(args);
  const AlignedVector<float> scale(200, 3);
  Propagate::Args scaled = args_of(q, std::span(&mode, 1));
  scaled.noise_scale = scale;
  device_.run<Propagate>(scaled);
  for (std::size_t i = 0; i < 200; ++i) {
    EXPECT_NEAR(q.x[i] - 103, 3 * (p.x[i] - 103), 1e-4);
    EXPECT_NEAR(q.vy[i] + 4, 3 * (p.vy[i] + 4), 1e-5);
  }
}

}  // namespace
}  // namespace glint::test

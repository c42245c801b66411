// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/particle_likelihood/particle_likelihood.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "glint/kernels/core/device.hpp"
#include "glint/kernels/particle_likelihood/polynomials.hpp"
#include "kernels/special_floats.hpp"

namespace glint {
namespace {

struct Cloud {
  std::vector<float> x, y, intensity;
};

std::vector<float> log_ratios(FrameView frame, double sigma, const Cloud& cloud,
                              const Device& device, float jitter = 0, RandomKey key = {}) {
  std::vector<float> out(cloud.x.size());
  device.run<ParticleLikelihood>({.frame = frame,
                                  .spread = PointSpread::of(sigma),
                                  .x = cloud.x,
                                  .y = cloud.y,
                                  .intensity = cloud.intensity,
                                  .log_ratio = out,
                                  .jitter = jitter,
                                  .key = key});
  return out;
}

float log_ratio(FrameView frame, double sigma, float x, float y, float intensity,
                const Device& device) {
  return log_ratios(frame, sigma, {{x}, {y}, {intensity}}, device)[0];
}

/// Sum of h z - h^2 / 2 over the window's pixels that the frame has; h integrated by Simpson's rule
/// over the pixel.
double brute_force(FrameView frame, const PointSpread& spread, double x, double y, double i) {
  const auto density = [&](double d) {
    return std::exp(-d * d / (2 * spread.sigma * spread.sigma)) /
           (std::sqrt(2 * std::acos(-1.0)) * spread.sigma);
  };
  const auto share = [&](int pixel, double centre) {
    constexpr int kSteps = 200;
    double sum = 0;
    for (int s = 0; s <= kSteps; ++s) {
      const double weight = s == 0 || s == kSteps ? 1 : s % 2 == 1 ? 4 : 2;
      sum += weight * density(pixel - 0.5 + static_cast<double>(s) / kSteps - centre);
    }
    return sum / (3 * kSteps);
  };
  const int column = static_cast<int>(std::floor(x + 0.5)),
            row = static_cast<int>(std::floor(y + 0.5));
  double sum = 0;
  for (int v = row - spread.half_width; v <= row + spread.half_width; ++v) {
    for (int u = column - spread.half_width; u <= column + spread.half_width; ++u) {
      if (!frame.contains(u, v)) continue;
      const double h = i * share(u, x) * share(v, y);
      sum += h * static_cast<double>(frame(u, v)) - h * h / 2;
    }
  }
  return sum;
}

class ParticleLikelihoodOn : public testing::TestWithParam<DeviceKind> {
 protected:
  Device device_ = GetParam() == DeviceKind::serial ? Device::serial() : Device::tbb(2);
};

TEST_P(ParticleLikelihoodOn, IsTheSumOverTheClippedWindow) {
  const Image<float> frame = noise_frame(23, 17);
  for (const double sigma : {0.3, 0.6, 0.7, 1.0, 1.5}) {
    for (int i = 0; i < 60; ++i) {
      const float x = -0.5f + 0.3827f * static_cast<float>(i);  // from edge to edge
      const float y = -0.45f + 0.2761f * static_cast<float>(i);
      const float got = log_ratio(frame, sigma, x, y, 9, device_);
      EXPECT_NEAR(got, brute_force(frame, PointSpread::of(sigma), x, y, 9), 2e-4)
          << "sigma " << sigma << " at " << x << ", " << y;
    }
  }
}

TEST_P(ParticleLikelihoodOn, HalfwayBelongsToThePixelOnTheRightAndBelow) {
  Image<float> frame(40, 40);
  frame.view()(23, 20) = 1;  // inside the window of pixel 21, not of pixel 20
  EXPECT_GT(log_ratio(frame, 0.7, 20.5f, 20, 5, device_),
            log_ratio(Image<float>(40, 40), 0.7, 20.5f, 20, 5, device_));
  Image<float> turned(40, 40);
  turned.view()(20, 23) = 1;
  EXPECT_GT(log_ratio(turned, 0.7, 20, 20.5f, 5, device_),
            log_ratio(Image<float>(40, 40), 0.7, 20, 20.5f, 5, device_));
}

TEST_P(ParticleLikelihoodOn, OutsideOrNotANumberIsImpossible) {
  const Image<float> frame = noise_frame(30, 20);
  const Cloud inside{{-0.5f, 29.49f, 3, 3}, {4, 4, -0.5f, 19.49f}, {5, 5, 5, 5}};
  for (const float l : log_ratios(frame, 0.7, inside, device_)) EXPECT_TRUE(std::isfinite(l));
  const Cloud outside{{-0.51f, 29.5f, 3, 3, kNan, kInfinity, 3, 3, 3, -1e30f},
                      {4, 4, -0.51f, 19.5f, 4, 4, kNan, 4, 4, 4},
                      {5, 5, 5, 5, 5, 5, 5, kNan, kInfinity, 5}};
  for (const float l : log_ratios(frame, 0.7, outside, device_)) EXPECT_EQ(l, -kInfinity);
}

TEST_P(ParticleLikelihoodOn, AnEmptyFrameHoldsNoParticle) {
  EXPECT_EQ(log_ratio({}, 0.7, 0, 0, 5, device_), -kInfinity);
}

TEST_P(ParticleLikelihoodOn, PeaksAtTheTarget) {
  Image<float> frame(40, 30);
  const PointSpread spread = PointSpread::of(1.0);
  const double x = 17.3, y = 12.8;
  for (int v = 0; v < 30; ++v) {
    for (int u = 0; u < 40; ++u) {
      frame.view()(u, v) =
          static_cast<float>(20 * spread.weight(u - 17, x - 17) * spread.weight(v - 13, y - 13));
    }
  }
  const float peak = log_ratio(frame, 1.0, 17.3f, 12.8f, 20, device_);
  for (const auto& [dx, dy, di] : {std::tuple{0.1f, 0.0f, 0.0f},
                                   {-0.1f, 0.0f, 0.0f},
                                   {0.0f, 0.1f, 0.0f},
                                   {0.0f, -0.1f, 0.0f},
                                   {0.0f, 0.0f, 1.0f},
                                   {0.0f, 0.0f, -1.0f}}) {
    EXPECT_LT(log_ratio(frame, 1.0, 17.3f + dx, 12.8f + dy, 20 + di, device_), peak);
  }
}

TEST_P(ParticleLikelihoodOn, JitterMovesTheParticleByTwoOfItsNormals) {
  const Image<float> frame = noise_frame(60, 50);
  const RandomKey key = random_key(11, 4, Purpose::jitter);
  Cloud cloud, moved;
  for (std::uint32_t i = 0; i < 130; ++i) {
    const float x = 5 + 0.37f * static_cast<float>(i), y = 4 + 0.31f * static_cast<float>(i);
    const Normals4 normals = random_normals(key, i);
    cloud.x.push_back(x), cloud.y.push_back(y), cloud.intensity.push_back(7);
    moved.x.push_back(x + 0.4f * normals.n[0]);
    moved.y.push_back(y + 0.4f * normals.n[1]);
    moved.intensity.push_back(7);
  }
  EXPECT_EQ(log_ratios(frame, 0.7, cloud, device_, 0.4f, key),
            log_ratios(frame, 0.7, moved, device_));
}

TEST_P(ParticleLikelihoodOn, RefusesSpansOfUnlikeLength) {
  const Image<float> frame(8, 8);
  const std::vector<float> two(2), three(3);
  std::vector<float> out(2);
  EXPECT_THROW(
      device_.run<ParticleLikelihood>(
          {.frame = frame.view(), .x = two, .y = three, .intensity = two, .log_ratio = out}),
      std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(Devices, ParticleLikelihoodOn,
                         testing::Values(DeviceKind::serial, DeviceKind::tbb),
                         [](const auto& device) { return std::string(name(device.param)); });

TEST(WeightPolynomials, StayWithinAMillionthOfTheErrorFunctions) {
  for (const double sigma : {0.2, 0.3, 0.44, 0.45, 0.6, 0.7, 1.0, 1.7, 2.6}) {
    const PointSpread spread = PointSpread::of(sigma);
    const WeightPolynomials p = fit_weights(spread);
    ASSERT_GT(p.terms, 0);
    for (int k = -spread.half_width; k <= spread.half_width; ++k) {
      for (double f = -0.5; f <= 0.5; f += 1.0 / 64) {
        const auto at = static_cast<std::size_t>(std::abs(k));
        double even = 0, odd = 0;
        for (int d = p.terms - 1; d >= 0; --d) {
          even = even * f * f + static_cast<double>(p.even[at][d]);
          odd = odd * f * f + static_cast<double>(p.odd[at][d]);
        }
        EXPECT_NEAR(k < 0 ? even - f * odd : even + f * odd, spread.weight(k, f), 1e-6)
            << "sigma " << sigma << " pixel " << k << " offset " << f;
      }
    }
  }
}

}  // namespace
}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/bench/baselines/plain.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace glint::bench {
namespace {

// Gaussian integrals of the 5 pixels around, for a target `offset` from the middle one's centre.
void axis_weights(double offset, double sigma, double (&weights)[5]) {
  double edge[6];
  for (int k = 0; k < 6; ++k) edge[k] = std::erf((k - 2.5 - offset) / (sigma * std::sqrt(2.0)));
  for (int k = 0; k < 5; ++k) weights[k] = 0.5 * (edge[k + 1] - edge[k]);
}

}  // namespace

void naive_pixel_likelihood(const PixelLikelihood::Args& args) {
  const auto z = std::get<ImageView<const float>>(args.frame);
  const auto map = args.map;
  double exact[5];
  axis_weights(0, args.spread.sigma, exact);
  float w[5], squares = 0;
  for (int k = 0; k < 5; ++k) {
    w[k] = static_cast<float>(exact[k]);
    squares += w[k] * w[k];
  }
  for (int y = 0; y < z.height; ++y) {
    for (int x = 0; x < z.width; ++x) {
      float sum = 0;
      for (int l = -2; l <= 2; ++l) {
        for (int k = -2; k <= 2; ++k) {
          if (z.contains(x + k, y + l)) sum += w[l + 2] * w[k + 2] * z(x + k, y + l);
        }
      }
      map(x, y) = sum;
    }
  }
  const float half_energy = 0.5f * args.intensity * args.intensity * squares * squares;
  for (int y = 0; y < z.height; ++y) {
    for (int x = 0; x < z.width; ++x) map(x, y) = args.intensity * map(x, y) - half_energy;
  }
  args.hits->clear();
  for (int y = 0; y < z.height; ++y) {
    for (int x = 0; x < z.width; ++x) {
      if (map(x, y) > args.threshold) args.hits->push_back({x, y, map(x, y)});
    }
  }
}

void erf_particle_likelihood(FrameView frame, double sigma, const Particles& particles,
                             std::size_t count, std::span<float> log_ratio) {
  for (std::size_t i = 0; i < count; ++i) {
    const int x = static_cast<int>(std::floor(particles.x[i] + 0.5));
    const int y = static_cast<int>(std::floor(particles.y[i] + 0.5));
    double wx[5], wy[5];
    axis_weights(particles.x[i] - x, sigma, wx);
    axis_weights(particles.y[i] - y, sigma, wy);
    double correlation = 0, energy = 0;
    for (int l = 0; l < 5; ++l) {
      for (int k = 0; k < 5; ++k) {
        const double h = wy[l] * wx[k];
        correlation += h * frame(x + k - 2, y + l - 2);
        energy += h * h;
      }
    }
    const double intensity = particles.intensity[i];
    log_ratio[i] = static_cast<float>(intensity * (correlation - 0.5 * intensity * energy));
  }
}

void std_propagate(Particles& particles, std::size_t count, double noise, double intensity_noise) {
  static std::mt19937_64 generator(1);
  std::normal_distribution<double> normal;
  // Cholesky factor of the constant-velocity noise of a unit step.
  const double a = std::sqrt(noise / 3), b = std::sqrt(noise) * std::sqrt(3.0) / 2,
               c = std::sqrt(noise) / 2, d = std::sqrt(intensity_noise);
  for (std::size_t i = 0; i < count; ++i) {
    const double n0 = normal(generator), n1 = normal(generator);
    const double m0 = normal(generator), m1 = normal(generator);
    particles.x[i] = static_cast<float>(particles.x[i] + particles.vx[i] + a * n0);
    particles.y[i] = static_cast<float>(particles.y[i] + particles.vy[i] + a * m0);
    particles.vx[i] = static_cast<float>(particles.vx[i] + b * n0 + c * n1);
    particles.vy[i] = static_cast<float>(particles.vy[i] + b * m0 + c * m1);
    particles.intensity[i] = static_cast<float>(particles.intensity[i] + d * normal(generator));
  }
}

void two_pointer_resample(std::span<const float> weights, std::span<std::uint32_t> ancestors) {
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  const double step = total / static_cast<double>(ancestors.size());
  double sum = weights[0];
  std::size_t i = 0;
  for (std::size_t j = 0; j < ancestors.size(); ++j) {
    const double position = (static_cast<double>(j) + 0.37) * step;
    while (sum < position && i + 1 < weights.size()) sum += weights[++i];
    ancestors[j] = static_cast<std::uint32_t>(i);
  }
}

}  // namespace glint::bench

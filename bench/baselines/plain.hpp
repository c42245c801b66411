// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "glint/kernels/core/frame.hpp"
#include "glint/kernels/core/particles.hpp"
#include "glint/kernels/pixel_likelihood/pixel_likelihood.hpp"

/// What a careful programmer writes first, with the standard library: yardsticks for the kernels.
namespace glint::bench {

/// Correlation with 25 checked taps a pixel, then the log-likelihood ratio, then the threshold.
void naive_pixel_likelihood(const PixelLikelihood::Args& args);

/// 5x5 window of exact pixel integrals in double, 12 erf a particle.
void erf_particle_likelihood(FrameView frame, double sigma, const Particles& particles,
                             std::size_t count, std::span<float> log_ratio);

/// Constant velocity in double with std::mt19937_64 and std::normal_distribution, 5 draws a
/// particle.
void std_propagate(Particles& particles, std::size_t count, double noise, double intensity_noise);

/// Systematic resampling with one running sum.
void two_pointer_resample(std::span<const float> weights, std::span<std::uint32_t> ancestors);

}  // namespace glint::bench

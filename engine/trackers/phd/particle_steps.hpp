// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <span>

#include "glint/engine/frames/target_appearance.hpp"
#include "glint/engine/trackers/phd/motion_bank.hpp"
#include "glint/kernels/core/device.hpp"
#include "glint/kernels/core/frame.hpp"
#include "glint/kernels/core/particles.hpp"

namespace glint {

/// What particles are moved and weighed by: the same in PhdFilter and TargetFilters.
struct ParticleModel {
  const MotionBank& bank;
  const TargetAppearance& appearance;
  const Device& device;
  std::uint64_t seed;
};

/// Moves particles by `step` [frame] to `frame`. P-PHD (31), (32), (34). `noise_scale` multiplies
/// the process noise's standard deviation of each, empty = 1.
void move_particles(const ParticleModel& model, std::int64_t frame, double step,
                    Particles& particles, std::span<const float> noise_scale = {});
/// Log-likelihood ratio of each particle in the frame `z`. P-PHD (13), (18)
void weigh_particles(const ParticleModel& model, const Frame& z, std::int64_t frame,
                     const Particles& particles, std::span<float> log_ratio);

/// Throws BytesError unless the arrays fit each other and what a bank of `modes` models moves.
void require_particles(const Particles& particles, std::size_t modes);

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "glint/engine/cue.hpp"
#include "glint/engine/frames/target_appearance.hpp"
#include "glint/engine/trackers/phd/motion_bank.hpp"
#include "glint/engine/tracks/step_clock.hpp"
#include "glint/kernels/core/particles.hpp"
#include "glint/kernels/core/random.hpp"

namespace glint {

/// Probability that a target is where a cue says.
inline constexpr double kCueExistence = 0.9;
/// Standard deviation of a cue's x and y unless it says [px].
inline constexpr double kCueSigma = 2;

/// Intensity of a new-born target, uniform in decibels: dim targets get as many particles as bright
/// ones.
float drawn_intensity(float low, float high, std::uint32_t word);
/// Its motion model; `birth` is by model and sums to 1.
std::uint32_t drawn_mode(std::span<const float> birth, std::uint32_t word);

/// What the particles of a cue are drawn from.
struct CuedBirth {
  const MotionBank& bank;
  const TargetAppearance& appearance;
  double speed_max;  ///< [px/frame]
  RandomKey key;     ///< of this cue
};
/// Writes the particles [first, first + count) but for their weights and labels. Positions are
/// normal about the cue, as are velocities with an eighth of `speed_max` if the cue has one, or
/// else uniform up to it; intensity and motion model are those of any new-born target.
void draw_cued(const CuedBirth& birth, const Cue& cue, const StepTime& at, Particles& particles,
               std::size_t first, std::size_t count);

}  // namespace glint

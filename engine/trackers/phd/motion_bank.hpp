// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "glint/engine/config.hpp"
#include "glint/kernels/propagate/propagate.hpp"

namespace glint {

/// Motion models a target may switch between, and the Markov chain of the switching.
struct MotionBank {
  std::vector<std::string> names;  ///< "cv", "ca", "ct+", "ct-"
  std::vector<MotionMode> modes;
  std::vector<float> switching;  ///< modes x modes, row = from; empty for one mode
  std::vector<float> birth;      ///< probability of each mode for a new-born target

  bool has_acceleration() const;
};

/// The bank named `name`: "cv", "ca", or "cv+ct" (constant velocity and turns both ways).
/// `noise` is the power spectral density of CV and CT [px^2/frame^3] and of CA's jerk
/// [px^2/frame^5], `turn_rate` is in [rad/frame]; switching and births follow P-PHD (39) and
/// section 5.2. Throws ConfigError for another name.
MotionBank motion_bank(const std::string& name, double noise, double turn_rate);

/// The bank for steps into the past of targets whose velocities have been reversed: turns go the
/// other way, and the Markov chain runs backwards from its stationary distribution.
MotionBank reversed(const MotionBank& bank);

/// How targets move. The unit of time is the frame interval, whatever the frame rate.
struct MotionConfig {
  std::string motion = "cv";
  double process_noise = 0.02;  ///< [px^2/frame^3]
  double turn_rate = 15;        ///< [deg/frame]
  double speed_max = 4;         ///< along each axis [px/frame]
  double survival = 0.99;       ///< probability of a target's survival from frame to frame
  MotionBank bank() const;
};
void describe(FieldList& f, MotionConfig& c);

}  // namespace glint

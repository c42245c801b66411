// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/models/motion_bank.hpp"

#include <algorithm>

#include "glint/engine/config.hpp"

namespace glint {

bool MotionBank::has_acceleration() const {
  return std::any_of(modes.begin(), modes.end(),
                     [](const MotionMode& m) { return m.motion == Motion::constant_acceleration; });
}

MotionBank motion_bank(const std::string& name, double noise, double turn_rate) {
  const auto q = static_cast<float>(noise), omega = static_cast<float>(turn_rate);
  const MotionMode cv{Motion::constant_velocity, 0, q};
  if (name == "cv") return {{"cv"}, {cv}, {}, {1}};
  if (name == "ca") return {{"ca"}, {{Motion::constant_acceleration, 0, q}}, {}, {1}};
  if (name == "cv+ct") {
    return {{"cv", "ct-", "ct+"},
            {cv, {Motion::coordinated_turn, -omega, q}, {Motion::coordinated_turn, omega, q}},
            {.8f, .1f, .1f, .3f, .6f, .1f, .3f, .1f, .6f},  // P-PHD (39)
            {.8f, .1f, .1f}};                               // P-PHD section 5.2
  }
  throw ConfigError("motion must be cv, ca or cv+ct, got '" + name + "'");
}

}  // namespace glint

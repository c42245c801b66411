// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>
#include <vector>

namespace glint {

/// Position [px] and velocity [px/s].
struct Kinematics {
  double x = 0, y = 0, vx = 0, vy = 0;
};

/// Where a target is, `age` [s] after its birth.
using Path = std::function<Kinematics(double age)>;

/// A stretch of constant velocity, or of a coordinated turn.
struct Leg {
  double duration = 0;   ///< [s]
  double turn_rate = 0;  ///< [rad/s], positive from x towards y (clockwise on the screen)
};

/// Flies `legs` one after the other from `start`, then straight on.
Path fly(const Kinematics& start, std::vector<Leg> legs = {});

/// A uniform cubic B-spline over control points {x, y} [px], at least four, flown at `pace` [1/s]
/// segments a second; straight on at the end. Throws std::invalid_argument for fewer points.
struct ControlPoint {
  double x = 0, y = 0;
};
Path fly_spline(std::vector<ControlPoint> control, double pace);

}  // namespace glint

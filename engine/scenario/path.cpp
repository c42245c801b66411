// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/scenario/path.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace glint {
namespace {

Kinematics straight(const Kinematics& s, double t) {
  return {s.x + s.vx * t, s.y + s.vy * t, s.vx, s.vy};
}

Kinematics turn(const Kinematics& s, double rate, double t) {
  if (rate == 0) return straight(s, t);
  const double sine = std::sin(rate * t), cosine = std::cos(rate * t);
  return {s.x + (s.vx * sine - s.vy * (1 - cosine)) / rate,
          s.y + (s.vx * (1 - cosine) + s.vy * sine) / rate, s.vx * cosine - s.vy * sine,
          s.vx * sine + s.vy * cosine};
}

/// Value and derivative, by the segment's own parameter 0 <= u <= 1.
std::pair<double, double> cubic(double p0, double p1, double p2, double p3, double u) {
  const double a = -p0 + 3 * p1 - 3 * p2 + p3, b = 3 * p0 - 6 * p1 + 3 * p2;
  const double c = -3 * p0 + 3 * p2, d = p0 + 4 * p1 + p2;
  return {(((a * u + b) * u + c) * u + d) / 6, ((3 * a * u + 2 * b) * u + c) / 6};
}

}  // namespace

Path fly(const Kinematics& start, std::vector<Leg> legs) {
  return [start, legs = std::move(legs)](double age) {
    Kinematics state = start;
    for (const Leg& leg : legs) {
      const double t = std::min(age, leg.duration);
      state = turn(state, leg.turn_rate, t);
      age -= t;
      if (age <= 0) return state;
    }
    return straight(state, age);
  };
}

Path fly_spline(std::vector<ControlPoint> control, double pace) {
  if (control.size() < 4) throw std::invalid_argument("a spline path needs four control points");
  return [control = std::move(control), pace](double age) {
    const auto segments = static_cast<double>(control.size() - 3);
    const double at = std::clamp(age * pace, 0.0, segments);
    const auto i = static_cast<std::size_t>(std::min(std::floor(at), segments - 1));
    const double u = at - static_cast<double>(i);
    const ControlPoint *p = &control[i], *q = p + 1, *r = p + 2, *s = p + 3;
    const auto [x, dx] = cubic(p->x, q->x, r->x, s->x, u);
    const auto [y, dy] = cubic(p->y, q->y, r->y, s->y, u);
    return straight({x, y, dx * pace, dy * pace}, age - at / pace);
  };
}

}  // namespace glint

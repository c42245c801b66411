// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/propagate/transition.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

namespace glint::propagate {
namespace {

void require(bool holds, const char* sentence) {
  if (!holds) throw std::invalid_argument(sentence);
}

// Q = q [[t^3/3, t^2/2], [t^2/2, t]]: white noise acceleration.
void velocity_noise(double q, double t, Move<double>& m) {
  m.xx = std::sqrt(q * t * t * t / 3);
  m.vx = std::sqrt(q * t * 3) / 2;
  m.vv = std::sqrt(q * t) / 2;
}

// Q = q [[t^5/20, t^4/8, t^3/6], [t^4/8, t^3/3, t^2/2], [t^3/6, t^2/2, t]]: white noise jerk.
void acceleration_noise(double q, double t, Move<double>& m) {
  m.xx = std::sqrt(q * std::pow(t, 5) / 20);
  m.vx = std::sqrt(q * std::pow(t, 3) * 5) / 4;
  m.vv = std::sqrt(q * std::pow(t, 3) / 3) / 4;
  m.ax = std::sqrt(q * t * 5) / 3;
  m.av = std::sqrt(q * t / 3);
  m.aa = std::sqrt(q * t) / 3;
}

Move<double> move_of(const MotionMode& mode, double t) {
  Move<double> m{};
  m.along = t;
  m.cosine = 1;
  if (mode.motion == Motion::constant_acceleration) {
    m.half = t * t / 2;
    m.time = t;
    acceleration_noise(mode.noise, t, m);
    return m;
  }
  velocity_noise(mode.noise, t, m);
  const double rate = mode.turn_rate;
  if (mode.motion != Motion::coordinated_turn || rate == 0) return m;
  m.along = std::sin(rate * t) / rate;
  m.across = 2 * std::pow(std::sin(rate * t / 2), 2) / rate;  // (1 - cos) / rate, digits kept
  m.cosine = std::cos(rate * t);
  m.sine = std::sin(rate * t);
  return m;
}

void check_modes(const Propagate::Args& args) {
  const std::size_t modes = args.modes.size(), n = args.x.size();
  require(modes >= 1 && modes <= Propagate::kMaxModes, "propagate takes 1 to 8 motion modes");
  for (const MotionMode& mode : args.modes) {
    require(mode.noise >= 0 && std::isfinite(mode.turn_rate),
            "a motion mode needs noise >= 0 and a finite turn rate");
    require(mode.motion != Motion::constant_acceleration ||
                (args.ax.size() == n && args.ay.size() == n),
            "a mode of constant acceleration needs ax and ay of every particle");
  }
  if (modes == 1) return;
  require(args.mode.size() == n, "several motion modes need the mode of every particle");
  require(args.switching.size() == modes * modes, "switching must be a matrix of modes x modes");
  for (std::size_t from = 0; from < modes; ++from) {
    double sum = 0;
    for (const float p : args.switching.subspan(from * modes, modes)) {
      require(p >= 0, "switching probabilities must not be negative");
      sum += p;
    }
    require(std::abs(sum - 1) < 1e-3, "every row of switching must sum to 1");
  }
}

Move<float> narrowed(const Move<double>& m) {
  const auto f = [](double v) { return static_cast<float>(v); };
  return {f(m.along), f(m.across), f(m.cosine), f(m.sine), f(m.xx), f(m.vx),
          f(m.vv),    f(m.half),   f(m.time),   f(m.ax),   f(m.av), f(m.aa)};
}

void set_cumulative(const Propagate::Args& args, Transition<double>& t) {
  const std::size_t modes = args.modes.size();
  for (std::size_t from = 0; from < modes && modes > 1; ++from) {
    double sum = 0;
    for (std::size_t to = 0; to < modes; ++to) {
      sum += args.switching[from * modes + to];
      t.cumulative[from][to] = static_cast<float>(sum);
    }
  }
}

}  // namespace

void check(const Propagate::Args& args) {
  const std::size_t n = args.x.size();
  require(args.y.size() == n && args.vx.size() == n && args.vy.size() == n &&
              args.intensity.size() == n &&
              (args.noise_scale.empty() || args.noise_scale.size() == n),
          "particle arrays must have one length");
  require(args.step >= 0 && args.intensity_noise >= 0,
          "the time step and the intensity noise must not be negative");
  require(args.intensity_low <= args.intensity_high, "the intensity range must have low <= high");
  check_modes(args);
}

Transition<double> transition_of(const Propagate::Args& args) {
  Transition<double> t{};
  t.modes = static_cast<int>(args.modes.size());
  for (std::size_t m = 0; m < args.modes.size(); ++m) {
    t.move[m] = move_of(args.modes[m], args.step);
    t.accelerates |= args.modes[m].motion == Motion::constant_acceleration;
  }
  set_cumulative(args, t);
  t.intensity_deviation = std::sqrt(static_cast<double>(args.intensity_noise) * args.step);
  return t;
}

Transition<float> narrowed(const Transition<double>& wide) {
  Transition<float> t{};
  t.modes = wide.modes;
  t.accelerates = wide.accelerates;
  for (std::size_t m = 0; m < Propagate::kMaxModes; ++m) {
    t.move[m] = narrowed(wide.move[m]);
    std::copy(std::begin(wide.cumulative[m]), std::end(wide.cumulative[m]),
              std::begin(t.cumulative[m]));
  }
  t.intensity_deviation = static_cast<float>(wide.intensity_deviation);
  return t;
}

}  // namespace glint::propagate

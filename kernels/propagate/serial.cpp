// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "glint/kernels/propagate/draws.hpp"
#include "glint/kernels/propagate/transition.hpp"

namespace glint {
namespace {

using propagate::Move;
using propagate::share_of;
using propagate::Transition;

using Normals = std::array<double, 4>;

Normals normals(RandomKey key, std::uint32_t item, std::uint32_t draw) {
  const Words4 words = random_words(key, item, draw);
  Normals n{};
  for (std::size_t pair = 0; pair < 2; ++pair) {
    const double radius = std::sqrt(-2 * std::log(double{uniform(words.w[2 * pair])}));
    const double angle = 2 * std::numbers::pi * (words.w[2 * pair + 1] >> 8) * 0x1p-24;
    n[2 * pair] = radius * std::cos(angle);
    n[2 * pair + 1] = radius * std::sin(angle);
  }
  return n;
}

std::uint32_t switched(const Propagate::Args& args, const Transition<double>& t, std::uint32_t i) {
  const auto [item, part] = share_of(i, 4);
  const RandomKey key = random_key(args.seed, args.frame, Purpose::switch_model);
  const float u = uniform(random_words(key, item).w[part]);
  const auto last = static_cast<std::uint32_t>(t.modes - 1);
  const float* cumulative = t.cumulative[std::min(args.mode[i], last)];
  return static_cast<std::uint32_t>(std::upper_bound(cumulative, cumulative + last, u) -
                                    cumulative);
}

// x' = F x + w. P-PHD (31), (32).
void move(const Propagate::Args& args, const Move<double>& m, RandomKey key, std::uint32_t i) {
  const double scale = args.noise_scale.empty() ? 1 : args.noise_scale[i];
  const bool has_acceleration = !args.ax.empty();
  const double x = args.x[i], y = args.y[i], vx = args.vx[i], vy = args.vy[i];
  const double ax = has_acceleration ? args.ax[i] : 0, ay = has_acceleration ? args.ay[i] : 0;
  const Normals n = normals(key, i, 0);
  const double nx0 = scale * n[0], nx1 = scale * n[1], ny0 = scale * n[2], ny1 = scale * n[3];

  args.x[i] = static_cast<float>(x + m.along * vx - m.across * vy + m.half * ax + m.xx * nx0);
  args.y[i] = static_cast<float>(y + m.across * vx + m.along * vy + m.half * ay + m.xx * ny0);
  args.vx[i] =
      static_cast<float>(m.cosine * vx - m.sine * vy + m.time * ax + m.vx * nx0 + m.vv * nx1);
  args.vy[i] =
      static_cast<float>(m.sine * vx + m.cosine * vy + m.time * ay + m.vx * ny0 + m.vv * ny1);
  if (m.time == 0) return;
  const auto [item, part] = share_of(i, 2);
  const Normals third = normals(key, item, propagate::kAccelerationDraw);
  const double nx2 = scale * third[2 * part], ny2 = scale * third[2 * part + 1];
  args.ax[i] = static_cast<float>(ax + m.ax * nx0 + m.av * nx1 + m.aa * nx2);
  args.ay[i] = static_cast<float>(ay + m.ax * ny0 + m.av * ny1 + m.aa * ny2);
}

double reflected(double value, double low, double high) {
  if (value < low) value = 2 * low - value;
  if (value > high) value = 2 * high - value;
  return std::clamp(value, low, high);
}

// I' = I + w_I. P-PHD (34).
void walk_intensity(const Propagate::Args& args, double deviation, RandomKey key, std::uint32_t i) {
  const double scale = args.noise_scale.empty() ? 1 : args.noise_scale[i];
  const auto [item, part] = share_of(i, 4);
  const double noise = deviation * scale * normals(key, item, propagate::kIntensityDraw)[part];
  args.intensity[i] = static_cast<float>(
      reflected(args.intensity[i] + noise, args.intensity_low, args.intensity_high));
}

}  // namespace

void Propagate::serial(const Args& args) {
  propagate::check(args);
  const Transition<double> t = propagate::transition_of(args);
  const RandomKey key = random_key(args.seed, args.frame, Purpose::propagate);
  for (std::uint32_t i = 0; i < args.x.size(); ++i) {
    std::uint32_t mode = 0;
    if (t.modes > 1) mode = args.mode[i] = switched(args, t, i);
    move(args, t.move[mode], key, i);
    walk_intensity(args, t.intensity_deviation, key, i);
  }
}

}  // namespace glint

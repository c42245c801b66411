// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/cued_particles.hpp"

#include <algorithm>
#include <cmath>

namespace glint {
namespace {

constexpr double kVelocityShare = 0.125;  // standard deviation of a known velocity, of speed_max
constexpr double kMostSpeed = 1e6;        // [px/frame]: float holds where it leads

}  // namespace

float drawn_intensity(float low, float high, std::uint32_t word) {
  return static_cast<float>(low * std::pow(double{high} / low, uniform(word)));
}

std::uint32_t drawn_mode(std::span<const float> birth, std::uint32_t word) {
  float u = uniform(word);
  std::uint32_t mode = 0;
  while (mode + 1 < birth.size() && u >= birth[mode]) u -= birth[mode++];
  return mode;
}

void draw_cued(const CuedBirth& birth, const Cue& cue, const StepTime& at, Particles& p,
               std::size_t first, std::size_t count) {
  const double sigma = std::min(cue.sigma_or(kCueSigma), kMostSpeed), speed = birth.speed_max;
  const auto velocity = [&](double known, float normal, std::uint32_t word) {
    const double v = cue.moves() ? known / at.velocity_scale + kVelocityShare * speed * normal
                                 : speed * (2 * uniform(word) - 1);
    return static_cast<float>(std::clamp(v, -kMostSpeed, kMostSpeed));
  };
  for (std::size_t i = 0; i < count; ++i) {
    const auto item = static_cast<std::uint32_t>(i);
    const Normals4 n = random_normals(birth.key, item, 0);
    const Words4 u = random_words(birth.key, item, 1);
    const std::size_t to = first + i;
    p.x[to] = static_cast<float>(cue.x + sigma * n.n[0]);
    p.y[to] = static_cast<float>(cue.y + sigma * n.n[1]);
    p.vx[to] = velocity(cue.vx, n.n[2], u.w[0]);
    p.vy[to] = velocity(cue.vy, n.n[3], u.w[1]);
    p.ax[to] = p.ay[to] = 0;
    p.intensity[to] = drawn_intensity(birth.appearance.intensity_low(),
                                      birth.appearance.intensity_high(), u.w[2]);
    p.mode[to] = drawn_mode(birth.bank.birth, u.w[3]);
  }
}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/particle_steps.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "glint/engine/state/bytes.hpp"
#include "glint/kernels/particle_likelihood/particle_likelihood.hpp"
#include "glint/kernels/propagate/propagate.hpp"

namespace glint {

void move_particles(const ParticleModel& model, std::int64_t frame, double step, Particles& p,
                    std::span<const float> noise_scale) {
  model.device.run<Propagate>({.x = p.x,
                               .y = p.y,
                               .vx = p.vx,
                               .vy = p.vy,
                               .intensity = p.intensity,
                               .ax = p.ax,
                               .ay = p.ay,
                               .mode = p.mode,
                               .modes = model.bank.modes,
                               .switching = model.bank.switching,
                               .step = static_cast<float>(step),
                               .intensity_noise = model.appearance.intensity_noise(),
                               .intensity_low = model.appearance.intensity_low(),
                               .intensity_high = model.appearance.intensity_high(),
                               .noise_scale = noise_scale,
                               .seed = model.seed,
                               .frame = static_cast<std::uint32_t>(frame)});
}

void weigh_particles(const ParticleModel& model, const Frame& z, std::int64_t frame,
                     const Particles& p, std::span<float> log_ratio) {
  model.device.run<ParticleLikelihood>(
      {.frame = z.for_kernels(),
       .spread = model.appearance.spread(),
       .x = p.x,
       .y = p.y,
       .intensity = p.intensity,
       .log_ratio = log_ratio,
       .jitter = model.appearance.jitter(),
       .key = random_key(model.seed, static_cast<std::uint64_t>(frame), Purpose::jitter)});
}

void require_particles(const Particles& particles, std::size_t modes) {
  std::apply(
      [&](const auto&... array) {
        require_bytes(((array.size() == particles.size()) && ...),
                      "arrays of particles do not fit each other");
      },
      Particles::fields(particles));
  const auto bounded = [](float v) { return std::abs(v) < 1e9F; };  // false for NaN
  for (const auto* values : {&particles.x, &particles.y, &particles.vx, &particles.vy}) {
    require_bytes(std::ranges::all_of(*values, bounded), "a particle is too far away or too fast");
  }
  require_bytes(std::ranges::all_of(particles.mode, [&](auto mode) { return mode < modes; }),
                "a particle has no such motion model");
  require_bytes(
      std::ranges::all_of(particles.weight, [](float w) { return w >= 0 && std::isfinite(w); }),
      "a particle's weight is negative or not finite");
}

}  // namespace glint

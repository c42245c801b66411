// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/propagate/propagate.hpp"

#include <memory>
#include <string>

#include "glint/bench/baselines/plain.hpp"
#include "glint/bench/data.hpp"
#include "glint/bench/kernels/suites.hpp"
#include "glint/bench/limits.hpp"

namespace glint::bench {
namespace {

constexpr std::size_t kCount = std::size_t{1} << 22;
constexpr float kNoise = 1e-3f, kIntensityNoise = 1e-2f;
constexpr MotionMode kVelocity{Motion::constant_velocity, 0, kNoise};

Propagate::Args args(Particles& p, std::size_t count) {
  const auto first = [count](auto& array) { return std::span(array).first(count); };
  Propagate::Args a{first(p.x), first(p.y), first(p.vx), first(p.vy),     first(p.intensity),
                    {},         {},         {},          {&kVelocity, 1}, {}};
  a.intensity_noise = kIntensityNoise;
  a.intensity_high = 100;
  a.seed = 1;
  return a;
}

std::function<void(const Device&)> kernel(const std::shared_ptr<Particles>& particles) {
  return [particles](const Device& device) {
    device.run<Propagate>(args(*particles, particles->size()));
  };
}

std::shared_ptr<Particles> cloud(std::size_t n) {
  return std::make_shared<Particles>(clouds(n, 50, 4096, 4096));
}

}  // namespace

Suite propagate_constant_velocity() {
  Suite suite("propagate: 4 M particles, constant velocity, 5 normals", "particle");
  const auto particles = cloud(kCount);
  suite.add_threads("glint", kCount, kernel(particles));
  suite.add_threads("limit: 5 arrays in place", kCount, [particles](const Device& device) {
    Particles& p = *particles;
    for (auto* array : {&p.x, &p.y, &p.vx, &p.vy, &p.intensity}) {
      scale_in_place(device.workers(), *array);
    }
  });
  constexpr std::size_t kFew = std::size_t{1} << 14;
  suite.add(
      {"std", 1, kFew, [particles] { std_propagate(*particles, kFew, kNoise, kIntensityNoise); }});
  suite.add({"serial", 1, kFew, [particles] { Propagate::serial(args(*particles, kFew)); }});
  suite.ratio_threads("of reading and writing in place", "glint", "limit: 5 arrays in place", {},
                      {{}, .5});
  suite.ratio_of_threads("of mt19937_64 and std::normal_distribution", "glint", "std", {8, 8},
                         {16, 16});
  suite.ratio_of_threads("of the serial reference", "glint", "serial", {}, {});
  suite.scaling("glint", {1.9, 1.9});
  return suite;
}

Suite propagate_growth() {
  Suite suite("propagate: growth with the particles", "particle");
  std::vector<std::string> names;
  for (const std::size_t n : {100000, 1000000, 10000000}) {
    names.push_back(std::to_string(n));
    suite.add({names.back(), 1, static_cast<double>(n),
               [run = kernel(cloud(n)), device = Device::tbb(1)] { run(device); }});
  }
  suite.growth("dearest / cheapest particle", names, {1.05, 1.15, true});
  return suite;
}

}  // namespace glint::bench

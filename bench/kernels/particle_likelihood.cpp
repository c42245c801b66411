// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/particle_likelihood/particle_likelihood.hpp"

#include <memory>
#include <string>

#include "glint/bench/baselines/plain.hpp"
#include "glint/bench/data.hpp"
#include "glint/bench/kernels/suites.hpp"
#include "glint/bench/limits.hpp"

namespace glint::bench {
namespace {

constexpr std::size_t kCount = 1000000;
constexpr int kTargets = 50;
constexpr double kSigma = 0.7;

struct Scene {
  Scene(FrameSize size, Particles cloud)
      : frame(noise_frame(size.width, size.height)), particles(std::move(cloud)) {
    log_ratio.resize(particles.size());
  }

  ParticleLikelihood::Args args(std::size_t count) {
    const auto first = [count](auto& array) { return std::span(array).first(count); };
    return {frame.view(),       PointSpread::of(kSigma),    first(particles.x),
            first(particles.y), first(particles.intensity), first(log_ratio)};
  }

  Image<float> frame;
  Particles particles;
  AlignedVector<float> log_ratio;
};

std::function<void(const Device&)> kernel(const std::shared_ptr<Scene>& scene) {
  return [scene](const Device& device) {
    device.run<ParticleLikelihood>(scene->args(scene->particles.size()));
  };
}

}  // namespace

Suite particle_likelihood_clouds(FrameSize size) {
  Suite suite("particle_likelihood: 1e6 around 50 targets, 5x5", "particle");
  const auto scene =
      std::make_shared<Scene>(size, clouds(kCount, kTargets, size.width, size.height));
  suite.add_threads("glint", kCount, kernel(scene));
  suite.add_threads("limit: read 12 B, write 4 B", kCount, [scene](const Device& device) {
    const Particles& p = scene->particles;
    combine(device.workers(), p.x, p.y, p.intensity, scene->log_ratio);
  });
  constexpr std::size_t kFew = 4000;
  suite.add({"12 erf", 1, kFew, [scene] {
               erf_particle_likelihood(scene->frame, kSigma, scene->particles, kFew,
                                       scene->log_ratio);
             }});
  suite.add({"serial", 1, kFew, [scene] { ParticleLikelihood::serial(scene->args(kFew)); }});
  suite.ratio_threads("of reading 12 B and writing 4 B", "glint", "limit: read 12 B, write 4 B", {},
                      {{}, .4});
  suite.ratio_of_threads("of 12 erf in double", "glint", "12 erf", {47, 47}, {95, 95});
  suite.ratio_of_threads("of the serial reference", "glint", "serial", {}, {});
  suite.scaling("glint", {1.9, 1.9});
  return suite;
}

Suite particle_likelihood_spread(FrameSize size) {
  Suite suite("particle_likelihood: 1e6 all over the frame, 5x5", "particle");
  for (const Order order : {Order::tiles, Order::random}) {
    const auto scene =
        std::make_shared<Scene>(size, spread_particles(kCount, size.width, size.height, order));
    suite.add_threads(order == Order::tiles ? "sorted" : "unsorted", kCount, kernel(scene));
  }
  suite.ratio_threads("sorted of unsorted", "sorted", "unsorted", {4, 4}, {4, 4});
  return suite;
}

Suite particle_likelihood_growth() {
  Suite suite("particle_likelihood: growth with the particles", "particle");
  const FrameSize size{1024, 1024};
  std::vector<std::string> names;
  for (const std::size_t n : {100000, 1000000, 10000000}) {
    const auto scene = std::make_shared<Scene>(size, clouds(n, kTargets, size.width, size.height));
    names.push_back(std::to_string(n));
    suite.add({names.back(), 1, static_cast<double>(n),
               [run = kernel(scene), device = Device::tbb(1)] { run(device); }});
  }
  suite.growth("dearest / cheapest particle", names, {1.05, 1.15, true});
  return suite;
}

}  // namespace glint::bench

// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/resample/resample.hpp"

#include <array>
#include <memory>
#include <string>

#include "glint/bench/baselines/plain.hpp"
#include "glint/bench/data.hpp"
#include "glint/bench/kernels/suites.hpp"
#include "glint/bench/limits.hpp"

namespace glint::bench {
namespace {

constexpr std::size_t kCount = 1000000;
constexpr std::size_t kMoved = 5;

struct Population {
  explicit Population(std::size_t n) : weights(random_weights(n)), ancestors(n) {
    for (std::size_t k = 0; k < kMoved; ++k) {
      from[k].assign(n, 1);
      to[k].assign(n, 0);
      moved[k] = {from[k].data(), to[k].data()};
    }
  }
  Resample::Args args(Resampling method, bool move) {
    Resample::Args a{weights, ancestors, method, random_key(1, 0, Purpose::resample)};
    if (move) a.moved = moved;
    a.workspace = &workspace;
    return a;
  }

  AlignedVector<float> weights;
  AlignedVector<std::uint32_t> ancestors;
  std::array<AlignedVector<float>, kMoved> from, to;
  std::array<MovedArray, kMoved> moved;
  ResampleWorkspace workspace;
};

std::function<void(const Device&)> kernel(const std::shared_ptr<Population>& population,
                                          Resampling method, bool move) {
  return [=](const Device& device) { device.run<Resample>(population->args(method, move)); };
}

}  // namespace

Suite resample_ancestors() {
  Suite suite("resample: 1e6, ancestors", "particle");
  const auto population = std::make_shared<Population>(kCount);
  suite.add_threads("systematic", kCount, kernel(population, Resampling::systematic, false));
  suite.add_threads("residual", kCount, kernel(population, Resampling::residual, false));
  suite.add({"two pointers", 1, kCount,
             [population] { two_pointer_resample(population->weights, population->ancestors); }});
  suite.add({"serial", 1, kCount,
             [population] { Resample::serial(population->args(Resampling::systematic, false)); }});
  suite.ratio_of_threads("systematic of two pointers", "systematic", "two pointers", {7, 7},
                         {13, 13});
  suite.ratio_of_threads("residual of two pointers", "residual", "two pointers", {7, 7}, {13, 13});
  suite.ratio_of_threads("systematic of the serial reference", "systematic", "serial", {}, {});
  suite.scaling("systematic", {1.6, 1.9});
  return suite;
}

Suite resample_moves() {
  Suite suite("resample: 1e6, with the move of 5 floats", "particle");
  const auto population = std::make_shared<Population>(kCount);
  suite.add_threads("systematic", kCount, kernel(population, Resampling::systematic, true));
  suite.add_threads("residual", kCount, kernel(population, Resampling::residual, true));
  suite.add_threads("limit: copy of 5 arrays", kCount, [population](const Device& device) {
    for (std::size_t k = 0; k < kMoved; ++k) {
      copy(device.workers(), population->from[k], population->to[k]);
    }
  });
  suite.ratio_threads("systematic of a copy", "systematic", "limit: copy of 5 arrays", {.29, .6},
                      {.43, .6});
  suite.ratio_threads("residual of a copy", "residual", "limit: copy of 5 arrays", {.29, .6},
                      {.43, .6});
  suite.scaling("systematic", {1.6, 1.9});
  return suite;
}

Suite resample_growth() {
  Suite suite("resample: growth with the particles", "particle");
  std::vector<std::string> names;
  for (const std::size_t n : {100000, 1000000, 10000000}) {
    const auto population = std::make_shared<Population>(n);
    names.push_back(std::to_string(n));
    suite.add({names.back(), 1, static_cast<double>(n),
               [run = kernel(population, Resampling::systematic, false), device = Device::tbb(1)] {
                 run(device);
               }});
  }
  suite.growth("dearest / cheapest particle", names, {1.05, 1.15, true});
  return suite;
}

}  // namespace glint::bench

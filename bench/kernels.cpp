// SPDX-License-Identifier: Apache-2.0
#include "glint/bench/kernels/suites.hpp"

namespace glint::bench {

std::vector<Result> bench_kernels(const Options& options) {
  std::vector<Result> results;
  const Budget budget = options.quick ? Budget{5, 2} : Budget{};
  const auto run = [&](const Suite& suite) {
    results.push_back(measure(suite, budget));
    if (options.done) options.done(results.back());
  };
  if (options.egl) {
    results.push_back(egl_bandwidth(*options.egl, options.size, options.quick));
    if (options.done) options.done(results.back());
    run(egl_trials(*options.egl));
    return results;
  }
  using FrameSuite = Suite (*)(FrameSize);
  for (const FrameSuite make :
       {pixel_likelihood_float, pixel_likelihood_u16, pixel_likelihood_hits,
        particle_likelihood_clouds, particle_likelihood_spread, cell_weights_clouds,
        find_points_noise, dp_stage_noise, prepare_frames, cell_integrals_many}) {
    Suite suite = make(options.size);
    if (options.size != kReferenceSize) suite.forget_targets();
    run(suite);
  }
  using ParticleSuite = Suite (*)();
  for (const ParticleSuite make : {propagate_constant_velocity, resample_ancestors, resample_moves,
                                   cell_integrals_one, cell_integrals_hundred, kernel_trials}) {
    run(make());
  }
  if (options.quick) return results;
  for (const ParticleSuite make : {pixel_likelihood_growth, particle_likelihood_growth,
                                   propagate_growth, resample_growth, cell_integrals_growth}) {
    run(make());
  }
  return results;
}

}  // namespace glint::bench

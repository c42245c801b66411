// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>

#include "glint/kernels/core/tiles.hpp"
#include "glint/kernels/core/workers.hpp"
#include "glint/kernels/particle_likelihood/check.hpp"
#include "glint/kernels/particle_likelihood/lanes.hpp"
#include "glint/kernels/particle_likelihood/particle_likelihood.hpp"
#include "glint/kernels/particle_likelihood/polynomials.hpp"

namespace glint {

void ParticleLikelihood::tbb(const Args& args, Workers& workers) {
  particle_likelihood::check(args);
  const FrameView& frame = args.frame;
  if (frame.empty()) {
    std::fill(args.log_ratio.begin(), args.log_ratio.end(),
              -std::numeric_limits<float>::infinity());
    return;
  }
  const ParticlePass pass{frame.data,
                          frame.pitch,
                          frame.width,
                          frame.height,
                          args.x.data(),
                          args.y.data(),
                          args.intensity.data(),
                          args.log_ratio.data(),
                          args.jitter,
                          args.key,
                          fit_weights(args.spread)};
  const auto half = static_cast<std::size_t>(args.spread.half_width);
  const ParticleRange range = particle_likelihood_lanes(workers.isa()).range[half];
  const Tiles tiles{args.x.size(), kParticleTile};
  workers.for_tiles(tiles.tiles(),
                    [&](std::size_t t) { range(pass, tiles.begin(t), tiles.end(t)); });
}

}  // namespace glint

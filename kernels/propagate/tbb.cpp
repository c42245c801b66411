// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <iterator>

#include "glint/kernels/core/tiles.hpp"
#include "glint/kernels/core/workers.hpp"
#include "glint/kernels/propagate/draws.hpp"
#include "glint/kernels/propagate/lanes.hpp"

namespace glint {
namespace {

using propagate::Transition;

static_assert(kParticleTile % propagate::kBlock == 0, "tiles must hold whole blocks of draws");

template <class T>
T* data_or_null(std::span<T> array) {
  return array.empty() ? nullptr : array.data();
}

}  // namespace

void Propagate::tbb(const Args& args, Workers& workers) {
  propagate::check(args);
  const Transition<double> transition = propagate::transition_of(args);
  const bool switches = transition.modes > 1, accelerates = transition.accelerates;
  const propagate::Step step{
      .arrays = {args.x.data(), args.y.data(), args.vx.data(), args.vy.data(),
                 args.intensity.data(), accelerates ? args.ax.data() : nullptr,
                 accelerates ? args.ay.data() : nullptr, switches ? args.mode.data() : nullptr,
                 data_or_null(args.noise_scale)},
      .transition = propagate::narrowed(transition),
      .intensity_low = args.intensity_low,
      .intensity_high = args.intensity_high,
      .key = random_key(args.seed, args.frame, Purpose::propagate),
      .switch_key = random_key(args.seed, args.frame, Purpose::switch_model)};
  const Tiles tiles{args.x.size(), kParticleTile};
  const PropagateLanes& lanes = propagate_lanes(workers.isa());
  workers.for_tiles(tiles.tiles(),
                    [&](std::size_t t) { lanes.move(step, tiles.begin(t), tiles.end(t)); });
}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <iterator>

#include "glint/kernels/core/tiles.hpp"
#include "glint/kernels/core/workers.hpp"
#include "glint/kernels/propagate/draws.hpp"
#include "glint/kernels/propagate/lanes.hpp"

namespace glint {
namespace {

using propagate::Move;
using propagate::Transition;

static_assert(kParticleTile % propagate::kBlock == 0, "tiles must hold whole blocks of draws");

template <class T>
T* data_or_null(std::span<T> array) {
  return array.empty() ? nullptr : array.data();
}

Move<float> narrowed(const Move<double>& m) {
  const auto f = [](double v) { return static_cast<float>(v); };
  return {f(m.along), f(m.across), f(m.cosine), f(m.sine), f(m.xx), f(m.vx),
          f(m.vv),    f(m.half),   f(m.time),   f(m.ax),   f(m.av), f(m.aa)};
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
      .transition = narrowed(transition),
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

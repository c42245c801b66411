// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "glint/kernels/cell_weights/cells.hpp"
#include "glint/kernels/cell_weights/lanes.hpp"
#include "glint/kernels/cell_weights/sort_cells.hpp"
#include "glint/kernels/core/tiles.hpp"

namespace glint {
namespace {

using cell_weights::Passes;

/// Calls f(r) for all runs, in tiles of about equally many particles.
template <class F>
void each_run(const CellRuns& runs, const Passes& passes, const F& f) {
  const Tiles tiles{runs.order.size(), kParticleTile};
  const auto run_at = [&](std::size_t position) {
    return static_cast<std::size_t>(
        std::lower_bound(runs.first.begin(), runs.first.end() - 1, position) - runs.first.begin());
  };
  passes.each(tiles.tiles(), [&](std::size_t t) {
    const std::size_t end = run_at(tiles.end(t));
    for (std::size_t r = run_at(tiles.begin(t)); r < end; ++r) f(r);
  });
}

/// Sum over a run in a fixed order, four at a time to hide the additions' latency.
double sum_of(const CellRuns& runs, std::size_t r, const float* weighted) {
  const std::uint32_t* const order = runs.order.data();
  std::uint32_t k = runs.first[r];
  const std::uint32_t end = runs.first[r + 1];
  double s0 = 0, s1 = 0, s2 = 0, s3 = 0;
  for (; k + 4 <= end; k += 4) {
    s0 += weighted[order[k]];
    s1 += weighted[order[k + 1]];
    s2 += weighted[order[k + 2]];
    s3 += weighted[order[k + 3]];
  }
  for (; k < end; ++k) s0 += weighted[order[k]];
  return (s0 + s1) + (s2 + s3);
}

/// Leaves w l where the caller wants it.
std::span<const float> weigh(const CellWeights::Args& args, const Passes& passes,
                             CellWorkspace& space) {
  const std::size_t n = args.x.size();
  space.keys.resize(n);
  if (args.weighted.empty()) space.weighted.resize(n);
  const std::span<float> weighted =
      args.weighted.empty() ? std::span(space.weighted) : args.weighted;
  const cell_weights::Particles particles{args.x.data(),         args.y.data(),
                                          args.predicted.data(), args.log_ratio.data(),
                                          space.keys.data(),     weighted.data()};
  const CellWeightsLanes& lanes = cell_weights_lanes(passes.workers.isa());
  const Tiles tiles{n, kParticleTile};
  passes.each(tiles.tiles(), [&](std::size_t t) {
    lanes.weigh(particles, args.width, args.height, tiles.begin(t), tiles.end(t));
  });
  return weighted;
}

// M, and B over the window that the likelihood uses.
void sum_cells(const CellWeights::Args& args, const Passes& passes, std::span<const float> weighted,
               CellWorkspace& space) {
  const CellRuns& runs = space.runs;
  space.cell_sum.resize(runs.size());
  space.box_sum.resize(runs.size());
  each_run(runs, passes, [&](std::size_t r) {
    space.cell_sum[r] = static_cast<float>(sum_of(runs, r, weighted.data()));
  });
  const int half_width = args.psi == Psi::window ? args.half_width : 0;
  const Tiles tiles{runs.size(), 512};
  passes.each(tiles.tiles(), [&](std::size_t t) {
    cell_weights::box_sums(runs, args.width, half_width, space.cell_sum.data(),
                           space.box_sum.data(), tiles.begin(t), tiles.end(t));
  });
}

// w' = w l / (lambda + Psi). P-PHD (14)-(16).
void update(const CellWeights::Args& args, const Passes& passes, std::span<const float> weighted,
            CellWorkspace& space) {
  CellRuns& runs = space.runs;
  runs.mass.resize(runs.size());
  each_run(runs, passes, [&](std::size_t r) {
    const float normaliser = args.clutter + space.box_sum[r];
    const float inverse = normaliser > 0 ? 1 / normaliser : 0;
    for (std::uint32_t k = runs.first[r]; k < runs.first[r + 1]; ++k) {
      const std::uint32_t i = runs.order[k];
      args.updated[i] = weighted[i] * inverse;
    }
    runs.mass[r] = space.cell_sum[r] * inverse;
  });
}

}  // namespace

void CellWeights::tbb(const Args& args, Workers& workers) {
  cell_weights::check(args);
  CellWorkspace own;
  CellWorkspace& space = args.workspace ? *args.workspace : own;
  const Passes passes{workers, args.x.size() >= kParticleTile};
  const std::span<const float> weighted = weigh(args, passes, space);
  const std::size_t outside =
      cell_weights::sort_cells(args.x.size(), args.width, args.height, passes, space);
  for (std::size_t k = args.x.size() - outside; k < args.x.size(); ++k) {
    args.updated[space.indices[k]] = 0;
  }
  sum_cells(args, passes, weighted, space);
  update(args, passes, weighted, space);
}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/core/tiles.hpp"
#include "glint/kernels/dp_stage/lanes.hpp"
#include "glint/kernels/dp_stage/near.hpp"

namespace glint {

void DpStage::tbb(const Args& a, Workers& workers) {
  dp_stage::check(a);
  if (a.reach <= kNearReach) return dp_stage::run_near(a, workers);
  constexpr std::size_t kRows = 8;  // a cell has (2 reach + 1)^2 candidates: few rows are a tile
  const Tiles rows{a.score.empty() ? 0 : static_cast<std::size_t>(a.score.height), kRows};
  const DpStageLanes& lanes = dp_stage_lanes(workers.isa());
  workers.for_tiles(rows.tiles(), [&](std::size_t t) {
    lanes.rows(a, static_cast<int>(rows.begin(t)), static_cast<int>(rows.end(t)));
  });
}

}  // namespace glint

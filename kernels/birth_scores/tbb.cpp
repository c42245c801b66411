// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <numeric>

#include "glint/kernels/birth_scores/birth_scores.hpp"
#include "glint/kernels/birth_scores/lanes.hpp"
#include "glint/kernels/core/tiles.hpp"

namespace glint {

void BirthScores::tbb(const Args& a, Workers& workers) {
  const BirthScoresLaneArgs lane_args{
      1 / a.intensity, a.intensity * a.energy / 2, 1 / a.energy, a.energy / 2,
      a.intensity_low, a.intensity_high,           a.low,        a.high};
  const auto& lanes = birth_scores_lanes(workers.isa());
  const Tiles rows{static_cast<std::size_t>(a.map.height), kRowTile};
  workers.for_tiles(a.map.empty() ? 0 : rows.tiles(), [&](std::size_t t) {
    for (auto y = static_cast<int>(rows.begin(t)); y < static_cast<int>(rows.end(t)); ++y) {
      float* const row = a.score.row(y);
      lanes.row(a.map.row(y), row, a.map.width, lane_args);
      for (const Box& box : a.masked) {
        if (y >= box.y0 && y < box.y1) std::fill(row + box.x0, row + box.x1, 0.0F);
      }
      if (a.row_sums.empty()) continue;
      a.row_sums[static_cast<std::size_t>(y)] = std::accumulate(row, row + a.score.width, 0.0);
    }
  });
}

}  // namespace glint

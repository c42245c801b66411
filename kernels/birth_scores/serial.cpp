// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numeric>

#include "glint/kernels/birth_scores/birth_scores.hpp"

namespace glint {

void BirthScores::serial(const Args& a) {
  const double intensity = a.intensity, energy = a.energy;
  for (int y = 0; y < a.map.height; ++y) {
    for (int x = 0; x < a.map.width; ++x) {
      // The map is I A - I^2 B / 2, P-PHD (13): get A back, then maximise over I.
      const double correlation = a.map(x, y) / intensity + intensity * energy / 2;
      const double best =
          std::clamp<double>(correlation / energy, a.intensity_low, a.intensity_high);
      const double ratio = best * (correlation - best * energy / 2);
      const auto masks = [&](const Box& box) { return box.contains(x, y); };
      const bool masked = std::ranges::any_of(a.masked, masks);
      const double score = masked ? 0 : std::exp(std::clamp<double>(ratio, a.low, a.high) / 2);
      a.score(x, y) = static_cast<float>(score);
    }
    if (a.row_sums.empty()) continue;
    const float* row = a.score.row(y);
    a.row_sums[static_cast<std::size_t>(y)] = std::accumulate(row, row + a.score.width, 0.0);
  }
}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/birth_scores/lanes.hpp"

#include "glint/kernels/core/math.hpp"

namespace glint::GLINT_LANES {
namespace {

void row(const float* __restrict map, float* __restrict score, int n,
         const BirthScoresLaneArgs& args) {
  const BirthScoresLaneArgs a = args;
  for (int x = 0; x < n; ++x) {
    const float correlation = math::fma(map[x], a.inverse_intensity, a.half_offset);
    const float best =
        math::clamp(correlation * a.inverse_energy, a.intensity_low, a.intensity_high);
    const float ratio = best * math::fma(-a.half_energy, best, correlation);
    score[x] = math::exp(0.5f * math::clamp(ratio, a.low, a.high));
  }
}

}  // namespace

extern const BirthScoresLanes birth_scores_lanes;
const BirthScoresLanes birth_scores_lanes{row};

}  // namespace glint::GLINT_LANES

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/kernels/core/isa.hpp"

namespace glint {

struct BirthScoresLaneArgs {
  float inverse_intensity, half_offset;  ///< A = map * inverse_intensity + half_offset
  float inverse_energy, half_energy;
  float intensity_low, intensity_high, low, high;
};

struct BirthScoresLanes {
  void (*row)(const float* map, float* score, int n, const BirthScoresLaneArgs& args);
};
GLINT_DECLARE_LANES(BirthScoresLanes, birth_scores_lanes)

}  // namespace glint

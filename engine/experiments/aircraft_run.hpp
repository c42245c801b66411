// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "glint/engine/trackers/h_pmht.hpp"
#include "glint/engine/trackers/imm_pda_ai.hpp"

namespace glint {

/// A tracker's run over the scene `aircraft`. NaN where undefined.
struct AircraftRun {
  double hit = 0;        ///< share of the scans [%]
  double deviation = 0;  ///< mean over the scans with an estimate [px]
};

/// One thread. The seed also chooses the variant of the scene.
AircraftRun run_aircraft(int scenario, const HPmhtConfig& config, std::uint64_t seed);
AircraftRun run_aircraft(int scenario, const ImmPdaAiConfig& config, std::uint64_t seed);

}  // namespace glint

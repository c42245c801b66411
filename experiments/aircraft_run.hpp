// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "glint/engine/trackers/h_pmht/h_pmht.hpp"
#include "glint/engine/trackers/imm_pda_ai/imm_pda_ai.hpp"

namespace glint {

/// A tracker's run over the scene `aircraft`. NaN where undefined.
struct AircraftRun {
  double hit = 0;        ///< share of the scans [%]
  double deviation = 0;  ///< mean over the scans with an estimate [px]
};

/// What a tracker is told of the target at the first scan: its place and, if it had two scans to
/// start from, its velocity.
enum class AircraftStart { two_scans, one_scan };

/// The seed also chooses the variant of the scene.
AircraftRun run_aircraft(int scenario, const HPmhtConfig& config, std::uint64_t seed,
                         AircraftStart start, const Device& device);
AircraftRun run_aircraft(int scenario, const ImmPdaAiConfig& config, std::uint64_t seed,
                         AircraftStart start, const Device& device);

}  // namespace glint

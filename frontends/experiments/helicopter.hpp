// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "glint/engine/scenario/truth.hpp"
#include "glint/engine/trackers/h_pmht/h_pmht_config.hpp"

namespace glint {

/// How h-pmht followed the one dark aircraft of a clip from a known start.
struct AircraftClip {
  double hit = 0;        ///< share of the frames within 10 px, half of the aircraft's label [%]
  double deviation = 0;  ///< mean distance from the labels' centres [px]
};

/// The 200x200 px about the middle of the aircraft's way; `intensity` is HPmhtConfig's. One thread.
/// Throws as open_source() does.
AircraftClip follow_aircraft(const std::string& clip, const std::vector<TruthPoint>& truth,
                             CellIntensity intensity);

}  // namespace glint

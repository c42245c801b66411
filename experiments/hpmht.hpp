// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/experiments/experiment.hpp"

namespace glint {

// P-HPMHT section 4 on the scene `aircraft`: 21 scans of every second frame, trackers started from
// the target's first position and velocity. A hit is an estimate that lies on the target; the
// deviation is its distance from the target's centroid, over the scans with an estimate.

/// Table 2: h-pmht beside imm-pda-ai in all seven scenarios.
ExperimentResult run_hpmht_table_2(const ExperimentOptions& options, Workers& workers);
/// Table 3: both at .9 and 1.1 of the threshold (23), cells kept as they are above it; h-pmht also
/// from the first position alone, the target thought at rest.
ExperimentResult run_hpmht_table_3(const ExperimentOptions& options, Workers& workers);

}  // namespace glint

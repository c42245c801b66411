// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/experiments/experiment.hpp"

namespace glint {

// P-PMHT section 4 on the scene `pmht-clip`, seen as points: trackers started on the first two
// points of every target. A target is lost if it is expected more than 14 px away three frames in
// a row, or at the end; errors are means over the targets that are not.

/// Table 1: one model, two models, with and without clutter, with and without noise.
ExperimentResult run_pmht_table_1(const ExperimentOptions& options, Workers& workers);
/// The three paths of the Monte Carlo runs, and whether errors are what the filter says.
ExperimentResult run_pmht_monte_carlo(const ExperimentOptions& options, Workers& workers);
/// Forty targets.
ExperimentResult run_pmht_40_targets(const ExperimentOptions& options, Workers& workers);

/// P-MMPF table A: particle filters on the same clips.
ExperimentResult run_mmpf_table_a(const ExperimentOptions& options, Workers& workers);

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/engine/experiments/experiment.hpp"

namespace glint {

/// P-PHD section 5.1 for every condition of ALGORITHMS.md part 2: OSPA (cut-off 5 px, order 2)
/// while the target is present and over all frames, GOSPA, cardinality error, RMSE, share of frames
/// detected, expected number of targets, with and without a target.
ExperimentResult run_phd_5_1(const ExperimentOptions& options, Workers& workers);

}  // namespace glint

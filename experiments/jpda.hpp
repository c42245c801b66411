// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/experiments/experiment.hpp"

namespace glint {

/// P-JPDA figure 2: three aircraft that manoeuvre past each other, seen by a radar; position errors
/// of a single scan and of windows, run by run, and tracks lost.
ExperimentResult run_jpda_fig2(const ExperimentOptions& options, Workers& workers);
/// Two targets that give one point for a while, and then two again.
ExperimentResult run_jpda_coalescence(const ExperimentOptions& options, Workers& workers);

}  // namespace glint

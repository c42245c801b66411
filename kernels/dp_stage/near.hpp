// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/kernels/core/workers.hpp"
#include "glint/kernels/dp_stage/dp_stage.hpp"

namespace glint::dp_stage {

/// The stage for a reach of at most kNearReach: in tiles whose rows of predecessors stay in the
/// first cache, with the moves that each predecessor refuses as bits.
void run_near(const DpStage::Args& args, Workers& workers);

}  // namespace glint::dp_stage

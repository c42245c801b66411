// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/kernels/core/isa.hpp"
#include "glint/kernels/dp_stage/dp_stage.hpp"

namespace glint {

struct DpStageLanes {
  void (*rows)(const DpStage::Args& args, int y0, int y1);
};
GLINT_DECLARE_LANES(DpStageLanes, dp_stage_lanes)

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
// Residuals of a band's pixels on the grid of RobustSpread; NaN where they are masked.
#include "glint/kernels/core/prelude.glsl"
#include "glint/kernels/prepare_frame/pass.glsl"

layout(std430, binding = 0) readonly buffer Parameters { ResidualBand pass; };
layout(std430, binding = 1) readonly buffer Image { float image[]; };
layout(std430, binding = 2) readonly buffer Background { float background[]; };
layout(std430, binding = 3) writeonly buffer Residuals { float residuals[]; };

void gather() {
  uint i = item();
  if (i >= pass.columns * pass.rows) return;
  uint x = i % pass.columns * pass.step, y = pass.first + i / pass.columns * pass.step;
  uint at = y * pass.width + x;
  precise float residual = image[at] - (pass.less != 0u ? background[at] : 0.0);
  residuals[i] = residual;
}

// SPDX-License-Identifier: Apache-2.0
// w l of each particle, and its cell; those in no pixel have the cell after the last.
#include "glint/kernels/core/prelude.glsl"
#include "glint/kernels/core/glsl.glsl"
#include "glint/kernels/core/math.glsl"
#include "glint/kernels/cell_weights/bound.glsl"
#include "glint/kernels/cell_weights/pass.glsl"

layout(std430, binding = 0) readonly buffer Parameters { CellPass pass; };
layout(std430, binding = 1) readonly buffer X { float xs[]; };
layout(std430, binding = 2) readonly buffer Y { float ys[]; };
layout(std430, binding = 3) readonly buffer Predicted { float predicted[]; };
layout(std430, binding = 4) readonly buffer LogRatio { float log_ratio[]; };
layout(std430, binding = 5) writeonly buffer Keys { uint keys[]; };
layout(std430, binding = 6) writeonly buffer Weighted { float weighted[]; };
layout(std430, binding = 7) writeonly buffer Updated { float updated[]; };

void weigh() {
  uint i = item();
  if (i >= pass.count) return;
  precise float column = xs[i] + 0.5, row = ys[i] + 0.5;  // the pixel is the floor
  bool inside = column >= 0.0 && column < float(pass.width) && row >= 0.0 &&
                row < float(pass.height);
  uint width = uint(pass.width);
  keys[i] = inside ? uint(row) * width + uint(column) : width * uint(pass.height);
  precise float product = predicted[i] * exp(bounded_log_ratio(log_ratio[i]));
  bool is_nan = (floatBitsToUint(log_ratio[i]) & 0x7fffffffu) > 0x7f800000u;
  weighted[i] = is_nan ? 0.0 : product;
  updated[i] = 0.0;
}

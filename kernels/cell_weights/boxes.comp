// SPDX-License-Identifier: Apache-2.0
// Sums of cells over windows. P-PHD (16).
#include "glint/kernels/core/prelude.glsl"
#include "glint/kernels/cell_weights/pass.glsl"

layout(std430, binding = 0) readonly buffer Parameters { CellPass pass; };
layout(std430, binding = 1) readonly buffer Cell { uint cell[]; };
layout(std430, binding = 2) readonly buffer CellSum { float cell_sum[]; };
layout(std430, binding = 3) writeonly buffer BoxSum { float box_sum[]; };

// The first run whose cell is not before `wanted`.
uint lower_bound(uint wanted) {
  uint low = 0u, high = pass.count;
  while (low < high) {
    uint middle = (low + high) / 2u;
    if (cell[middle] < wanted) low = middle + 1u;
    else high = middle;
  }
  return low;
}

// B of a run: M over the window, in ascending order of pixels.
void sum_boxes() {
  uint run = item();
  if (run >= pass.count) return;
  int x = int(cell[run] % uint(pass.width)), y = int(cell[run] / uint(pass.width));
  int left = max(0, x - pass.half_width), right = min(pass.width - 1, x + pass.half_width);
  int bottom = min(pass.height - 1, y + pass.half_width);
  precise double sum = 0.0lf;
  for (int row = max(0, y - pass.half_width); row <= bottom; ++row) {
    uint start = uint(row) * uint(pass.width), last = start + uint(right);
    for (uint r = lower_bound(start + uint(left)); r < pass.count && cell[r] <= last; ++r) {
      sum += double(cell_sum[r]);
    }
  }
  box_sum[run] = float(sum);
}

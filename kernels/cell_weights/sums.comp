// SPDX-License-Identifier: Apache-2.0
// Sums over cells and the update of the weights. P-PHD (14), (15).
#include "glint/kernels/core/prelude.glsl"
#include "glint/kernels/cell_weights/pass.glsl"

layout(std430, binding = 0) readonly buffer Parameters { CellPass pass; };
layout(std430, binding = 1) readonly buffer Order { uint order[]; };
layout(std430, binding = 2) readonly buffer First { uint first[]; };
layout(std430, binding = 3) readonly buffer Weighted { float weighted[]; };
layout(std430, binding = 4) buffer CellSum { float cell_sum[]; };
layout(std430, binding = 5) readonly buffer BoxSum { float box_sum[]; };
layout(std430, binding = 6) writeonly buffer Updated { float updated[]; };
layout(std430, binding = 7) writeonly buffer Mass { float mass[]; };

// M of a run, in the particles' order.
void sum_cells() {
  uint run = item();
  if (run >= pass.count) return;
  precise double sum = 0.0lf;
  for (uint k = first[run]; k < first[run + 1u]; ++k) sum += double(weighted[order[k]]);
  cell_sum[run] = float(sum);
}

// w' = w l / (lambda + Psi).
void update() {
  uint run = item();
  if (run >= pass.count) return;
  precise float normaliser = pass.clutter + box_sum[run];
  precise float inverse = normaliser > 0.0 ? 1.0 / normaliser : 0.0;
  for (uint k = first[run]; k < first[run + 1u]; ++k) {
    updated[order[k]] = weighted[order[k]] * inverse;
  }
  mass[run] = cell_sum[run] * inverse;
}

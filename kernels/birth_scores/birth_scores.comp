// SPDX-License-Identifier: Apache-2.0
// exp(r / 2) of every pixel, with r the ratio of its best intensity; 0 where boxes mask it.
#include "glint/kernels/core/prelude.glsl"
#include "glint/kernels/core/glsl.glsl"
#include "glint/kernels/core/math.glsl"
#include "glint/kernels/birth_scores/pass.glsl"

layout(std430, binding = 0) readonly buffer Parameters { ScorePass pass; };
layout(std430, binding = 1) readonly buffer Map { float map[]; };
layout(std430, binding = 2) buffer Scores { float scores_of[]; };
layout(std430, binding = 3) readonly buffer Boxes { MaskBox boxes[]; };
layout(std430, binding = 4) writeonly buffer RowSums { double row_sums[]; };

bool masked(int x, int y) {
  for (uint i = 0u; i < pass.boxes; ++i) {
    MaskBox box = boxes[i];
    if (x >= box.x0 && x < box.x1 && y >= box.y0 && y < box.y1) return true;
  }
  return false;
}

void scores() {
  int i = int(item());
  if (i >= pass.width * pass.rows) return;
  // The map is I A - I^2 B / 2, P-PHD (13): get A back, then maximise over I.
  precise float correlation = map[i] / pass.intensity + 0.5 * pass.intensity * pass.energy;
  precise float best = clamp(correlation / pass.energy, pass.intensity_low, pass.intensity_high);
  precise float ratio = best * (correlation - 0.5 * best * pass.energy);
  bool none = masked(i % pass.width, pass.top + i / pass.width);
  scores_of[i] = none ? 0.0 : exp(0.5 * clamp(ratio, pass.low, pass.high));
}

void sum_rows() {
  int row = int(item());
  if (row >= pass.rows) return;
  precise double sum = 0.0lf;
  for (int x = 0; x < pass.width; ++x) sum += double(scores_of[row * pass.width + x]);
  row_sums[row] = sum;
}

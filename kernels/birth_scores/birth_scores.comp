// SPDX-License-Identifier: Apache-2.0
// exp(r / 2) of every pixel, with r the ratio of its best intensity.
#include "glint/kernels/core/prelude.glsl"
#include "glint/kernels/core/glsl.glsl"
#include "glint/kernels/core/math.glsl"
#include "glint/kernels/birth_scores/pass.glsl"

layout(std430, binding = 0) readonly buffer Parameters { ScorePass pass; };
layout(std430, binding = 1) buffer Map { float map[]; };  // becomes the score

void scores() {
  int i = int(item());
  if (i >= pass.count) return;
  // The map is I A - I^2 B / 2, P-PHD (13): get A back, then maximise over I.
  precise float correlation = map[i] / pass.intensity + 0.5 * pass.intensity * pass.energy;
  precise float best = clamp(correlation / pass.energy, pass.intensity_low, pass.intensity_high);
  precise float ratio = best * (correlation - 0.5 * best * pass.energy);
  map[i] = exp(0.5 * clamp(ratio, pass.low, pass.high));
}

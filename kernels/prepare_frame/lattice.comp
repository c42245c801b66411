// SPDX-License-Identifier: Apache-2.0
// Medians over a lattice of 5x5 pixels.
#include "glint/kernels/core/prelude.glsl"
#include "glint/kernels/prepare_frame/keys.glsl"
#include "glint/kernels/prepare_frame/median.glsl"
#include "glint/kernels/prepare_frame/pass.glsl"

layout(std430, binding = 0) readonly buffer Parameters { MedianBand band; };
layout(std430, binding = 1) readonly buffer Image { float image[]; };
layout(std430, binding = 2) writeonly buffer Medians { float medians[]; };

ivec2 centre;  // of this invocation

uint key_of_sample(int i) {
  int x = clamp(centre.x + (i % 5 - 2) * band.spacing, 0, band.width - 1);
  int y = clamp(centre.y + (i / 5 - 2) * band.spacing, 0, band.height - 1);
  return key_of(image[(y - band.top) * band.width + x]);
}
int whole(int count) { return count; }

void spatial_median() {
  int i = int(item());
  if (i >= band.width * (band.last - band.first)) return;
  centre = ivec2(i % band.width, band.first + i / band.width);
  Samples samples = Samples(25, 0, 1, 32);
  int n = known(samples);
  uint lower = key_of_rank(samples, (n - 1) / 2);
  uint upper = (n & 1) == 0 ? key_of_rank(samples, n / 2) : lower;
  precise float sum = value_of(lower) + value_of(upper);
  medians[i] = n == 0 ? uintBitsToFloat(0x7fc00000u) : sum * 0.5;
}

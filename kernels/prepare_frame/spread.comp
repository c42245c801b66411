// SPDX-License-Identifier: Apache-2.0
// Median of residuals and of their distances from it, by one group of invocations.
#include "glint/kernels/core/prelude.glsl"
#include "glint/kernels/prepare_frame/keys.glsl"
#include "glint/kernels/prepare_frame/median.glsl"
#include "glint/kernels/prepare_frame/pass.glsl"

layout(std430, binding = 0) readonly buffer Parameters { SpreadPass pass; };
layout(std430, binding = 1) readonly buffer Residuals { float residuals[]; };
layout(std430, binding = 2) writeonly buffer Spread { float spread[]; };

const int kParts = 64;  // invocations of a group
shared int counts[kParts];

int whole(int count) {
  counts[gl_LocalInvocationID.x] = count;
  memoryBarrierShared();
  barrier();
  int sum = 0;
  for (int i = 0; i < kParts; ++i) sum += counts[i];
  barrier();
  return sum;
}

bool distances = false;  // whether samples are distances from the median
float median = 0.0;

uint key_of_sample(int i) {
  precise float distance = residuals[i] - median;
  return key_of(distances ? abs(distance) : residuals[i]);
}

float middle(Samples samples) {
  uint lower = key_of_rank(samples, (samples.n - 1) / 2);
  uint upper = key_of_rank(samples, samples.n / 2);
  precise float sum = value_of(lower) + value_of(upper);
  return sum * 0.5;
}

void robust_spread() {
  Samples samples = Samples(pass.count, int(gl_LocalInvocationID.x), kParts, 32);
  median = middle(samples);
  distances = true;
  float distance = middle(samples);
  if (item() != 0u) return;
  spread[0] = median;
  spread[1] = distance;
}

// SPDX-License-Identifier: Apache-2.0
// White noise: pixel p gets normal p % 4 of item p / 4.
#include "glint/kernels/core/prelude.glsl"
#include "glint/kernels/core/glsl.glsl"
#include "glint/kernels/core/math.glsl"
#include "glint/kernels/core/random.glsl"
#include "glint/kernels/add_noise/pass.glsl"

layout(std430, binding = 0) readonly buffer Parameters { NoisePass pass; };
layout(std430, binding = 1) buffer Image { float image[]; };

void add() {
  uint i = item(), pixel = pass.first + i;
  if (i >= pass.count) return;
  Words4 words = keyed_words(pass.key, pixel / 4u, 0u);
  uint pair = pixel & 2u;
  NormalPair normals = normals_of(words.w[pair], words.w[pair + 1u]);
  image[i] = fma(pass.sigma, (pixel & 1u) == 0u ? normals.n0 : normals.n1, image[i]);
}

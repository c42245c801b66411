// SPDX-License-Identifier: Apache-2.0
// Medians over a stack of images, which lie in words one after the other.
#include "glint/kernels/core/prelude.glsl"
#include "glint/kernels/prepare_frame/keys.glsl"
#include "glint/kernels/prepare_frame/median.glsl"
#include "glint/kernels/prepare_frame/pass.glsl"

layout(std430, binding = 0) readonly buffer Parameters { MedianBand band; };
layout(std430, binding = 1) readonly buffer Stack { uint stack[]; };
layout(std430, binding = 2) writeonly buffer Medians { float medians[]; };

int pixel;  // of this invocation

int pixels() { return band.width * (band.last - band.first); }

uint key_of_sample(int image) {
  uint i = uint(image) * uint(pixels()) + uint(pixel);
  if (band.bytes == 4u) return key_of(uintBitsToFloat(stack[i]));
  uint in_word = 4u / band.bytes, bits = 8u * band.bytes;
  return bitfieldExtract(stack[i / in_word], int(i % in_word * bits), int(bits));
}
int whole(int count) { return count; }

float sample_of(uint key) { return band.bytes == 4u ? value_of(key) : float(key); }

void stack_median() {
  pixel = int(item());
  if (pixel >= pixels()) return;
  Samples samples = Samples(int(band.images), 0, 1, 8 * int(band.bytes));
  int n = known(samples);
  uint lower = key_of_rank(samples, (n - 1) / 2);
  uint upper = (n & 1) == 0 ? key_of_rank(samples, n / 2) : lower;
  precise float sum = sample_of(lower) + sample_of(upper);
  medians[pixel] = n == 0 ? uintBitsToFloat(0x7fc00000u) : sum * 0.5;
}

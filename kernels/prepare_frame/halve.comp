// SPDX-License-Identifier: Apache-2.0
// Means of 2x2 pixels.
#include "glint/kernels/core/prelude.glsl"
#include "glint/kernels/prepare_frame/pass.glsl"

layout(std430, binding = 0) readonly buffer Parameters { HalfBand band; };
layout(std430, binding = 1) readonly buffer Image { float image[]; };
layout(std430, binding = 2) writeonly buffer Half { float half_image[]; };

void halve() {
  uint i = item();
  if (i >= band.pixels) return;
  int half_width = band.half_width;
  int at = int(i) / half_width * 2 * band.width + int(i) % half_width * 2;
  precise float upper = image[at] + image[at + 1];
  precise float lower = image[at + band.width] + image[at + band.width + 1];
  precise float mean = 0.25 * (upper + lower);
  half_image[i] = mean;
}

// SPDX-License-Identifier: Apache-2.0
// The background's morphological gradient over 3x3, then its largest of 5x5.
#include "glint/kernels/core/prelude.glsl"
#include "glint/kernels/prepare_frame/keys.glsl"
#include "glint/kernels/prepare_frame/pass.glsl"

layout(std430, binding = 0) readonly buffer Parameters { StructureBand band; };
layout(std430, binding = 1) readonly buffer From { float from[]; };  // background, or gradients
layout(std430, binding = 2) writeonly buffer To { float to[]; };     // gradients, or structure

bool in_frame(int x, int y) { return x >= 0 && y >= 0 && x < band.width && y < band.height; }
float value_at(int x, int y) { return from[(y - band.top) * band.width + x]; }

bool is_made(int i) { return i < band.width * (band.last - band.first); }
ivec2 place(int i) { return ivec2(i % band.width, band.first + i / band.width); }

void gradient() {
  int i = int(item());
  if (!is_made(i)) return;
  ivec2 at = place(i);
  float high = uintBitsToFloat(0xff800000u), low = uintBitsToFloat(0x7f800000u);
  for (int k = 0; k < 9; ++k) {
    int x = at.x + k % 3 - 1, y = at.y + k / 3 - 1;
    if (!in_frame(x, y) || is_nan(value_at(x, y))) continue;
    high = max(high, value_at(x, y));
    low = min(low, value_at(x, y));
  }
  precise float difference = high - low;
  to[i] = high >= low ? difference : 0.0;
}

void dilate() {
  int i = int(item());
  if (!is_made(i)) return;
  ivec2 at = place(i);
  float most = 0.0;
  for (int k = 0; k < 25; ++k) {
    int x = at.x + k % 5 - 2, y = at.y + k / 5 - 2;
    if (in_frame(x, y)) most = max(most, value_at(x, y));
  }
  precise float structure = band.share * most;
  to[i] = structure;
}

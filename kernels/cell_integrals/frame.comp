// SPDX-License-Identifier: Apache-2.0
// ||Z|| and the displayed cells of spans of rows. P-HPMHT (9)
#include "glint/kernels/core/prelude.glsl"
#include "glint/kernels/cell_integrals/pass.glsl"

layout(std430, binding = 0) readonly buffer Parameters { CellBand band; };
layout(std430, binding = 1) readonly buffer Frame { float frame[]; };
layout(std430, binding = 2) readonly buffer Boxes { ivec4 boxes[]; };
layout(std430, binding = 3) writeonly buffer Norms { double norms[]; };
layout(std430, binding = 4) writeonly buffer Shown { uint shown[]; };
#include "glint/kernels/cell_integrals/pixels.glsl"

void sum_cells() {
  uint i = item();
  if (i >= band.items) return;
  int spans = (band.width + kSpan - 1) / kSpan;
  int row = int(i) / spans, left = int(i) % spans * kSpan;
  precise double norm = 0.0lf;
  uint count = 0u;
  for (int x = left; x < min(left + kSpan, band.width); ++x) {
    float pixel = frame[row * band.width + x];
    bool missing = is_missing(pixel, x, band.first + row);
    norm += double(missing ? 0.0 : intensity(pixel));
    count += missing ? 0u : 1u;
  }
  norms[i] = norm;
  shown[i] = count;
}

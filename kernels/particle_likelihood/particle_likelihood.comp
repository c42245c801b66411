// SPDX-License-Identifier: Apache-2.0
// Log-likelihood ratio of each particle over the window around the pixel that holds it. P-PHD (13),
// (18).
#include "glint/kernels/core/prelude.glsl"
#include "glint/kernels/core/glsl.glsl"
#include "glint/kernels/core/math.glsl"
#include "glint/kernels/core/random.glsl"
#include "glint/kernels/particle_likelihood/pass.glsl"

layout(std430, binding = 0) readonly buffer Parameters { ParticleBand band; };
layout(std430, binding = 1) readonly buffer Frame { float frame[]; };
layout(std430, binding = 2) readonly buffer X { float xs[]; };
layout(std430, binding = 3) readonly buffer Y { float ys[]; };
layout(std430, binding = 4) readonly buffer Intensity { float intensities[]; };
layout(std430, binding = 5) writeonly buffer LogRatio { float log_ratio[]; };

// Weight of the pixel k away from the particle's, at `offset` from its centre.
float weight(int k, float offset) {
  if (band.terms == 0) {
    precise float above = erf((float(k) + 0.5 - offset) * band.scale);
    precise float below = erf((float(k) - 0.5 - offset) * band.scale);
    return 0.5 * (above - below);
  }
  precise float square = offset * offset;
  int at = 8 * abs(k), last = band.terms - 1;
  precise float even = band.even[at + last], odd = band.odd[at + last - 1];
  for (int d = last - 1; d >= 0; --d) {
    even = even * square + band.even[at + d];
    if (d < last - 1) odd = odd * square + band.odd[at + d];
  }
  if (k == 0) return even;
  precise float side = offset * odd;
  return k > 0 ? even + side : even - side;
}

// Sum of the squared weights of the pixels that the frame has.
float energy(int pixel, float offset, int size) {
  precise float sum = 0.0;
  for (int k = -band.half_width; k <= band.half_width; ++k) {
    if (pixel + k < 0 || pixel + k >= size) continue;
    float w = weight(k, offset);
    sum += w * w;
  }
  return sum;
}

float matched(int column, int row, float dx, float dy) {
  precise float sum = 0.0;
  float of_column[15];
  for (int k = -band.half_width; k <= band.half_width; ++k) {
    bool seen = column + k >= 0 && column + k < band.width;
    of_column[k + band.half_width] = seen ? weight(k, dx) : 0.0;
  }
  for (int l = -band.half_width; l <= band.half_width; ++l) {
    if (row + l < 0 || row + l >= band.height) continue;
    int start = (row + l - band.top) * band.width + column;
    precise float line = 0.0;
    for (int k = -band.half_width; k <= band.half_width; ++k) {
      float w = of_column[k + band.half_width];
      if (w != 0.0) line += w * frame[start + k];
    }
    sum += weight(l, dy) * line;
  }
  return sum;
}

bool inside(float edge, int size) { return edge >= 0.0 && edge < float(size); }
bool finite(float x) { return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u; }

void ratios() {
  uint i = item();
  if (i >= band.count) return;
  precise float x = xs[i], y = ys[i];
  if (band.jitter > 0.0) {
    Words4 words = keyed_words(band.key, band.first + i, 0u);
    NormalPair normals = normals_of(words.w[0], words.w[1]);
    x += band.jitter * normals.n0;
    y += band.jitter * normals.n1;
  }
  precise float from_left = x + 0.5, from_top = y + 0.5, intensity = intensities[i];
  if (!(inside(from_left, band.width) && inside(from_top, band.height) && finite(intensity))) {
    log_ratio[i] = uintBitsToFloat(0xff800000u);
    return;
  }
  int column = int(from_left), row = int(from_top);
  if (row < band.row_first || row >= band.row_last) return;
  precise float dx = x - float(column), dy = y - float(row);
  precise float cost = energy(column, dx, band.width) * energy(row, dy, band.height);
  cost = intensity * intensity * cost * 0.5;
  precise float value = intensity * matched(column, row, dx, dy) - cost;
  log_ratio[i] = value;
}

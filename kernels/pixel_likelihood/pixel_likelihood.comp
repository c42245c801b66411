// SPDX-License-Identifier: Apache-2.0
// Log-likelihood ratio of every pixel: I A - I^2 B / 2, P-PHD (13), with A the correlation of the
// frame with the point spread, by columns, then by rows; then the pixels above the threshold.
#include "glint/kernels/core/prelude.glsl"
#include "glint/kernels/pixel_likelihood/pass.glsl"

layout(std430, binding = 0) readonly buffer Parameters { PixelBand band; };
layout(std430, binding = 1) readonly buffer Frame { uint frame[]; };
layout(std430, binding = 2) buffer Sums { float sums[]; };
layout(std430, binding = 3) buffer Map { float map[]; };
layout(std430, binding = 4) buffer Counts { uint counts[]; };  // of a span; later, of all before it
struct Hit {
  int x, y;
  float value;
};
layout(std430, binding = 5) writeonly buffer Hits { Hit hits[]; };

int pixels() { return band.width * (band.last - band.first); }

float pixel(int x, int y) {
  uint i = uint((y - band.top) * band.width + x);
  if (band.uint16 == 0u) return uintBitsToFloat(frame[i]) - band.offset;
  uint pair = frame[i >> 1];
  return float((i & 1u) == 0u ? pair & 0xffffu : pair >> 16) - band.offset;
}

// Sums along y of the rows that the frame has.
void columns() {
  int i = int(item());
  if (i >= pixels()) return;
  int x = i % band.width, y = band.first + i / band.width;
  precise float sum = band.relative[0] * pixel(x, y);
  for (int k = 1; k <= band.half_width; ++k) {
    precise float pair = 0.0;
    if (y >= k) pair += pixel(x, y - k);
    if (y + k < band.height) pair += pixel(x, y + k);
    sum += band.relative[k] * pair;
  }
  sums[i] = sum;
}

// Share of the energy B along one axis, of the pixels that the frame has.
float energy(int at, int size) {
  precise float sum = band.squared[0];
  for (int k = 1; k <= band.half_width; ++k) {
    if (at >= k) sum += band.squared[k];
    if (at + k < size) sum += band.squared[k];
  }
  return sum;
}

void ratios() {
  int i = int(item());
  if (i >= pixels()) return;
  int x = i % band.width, y = band.first + i / band.width;
  precise float sum = band.relative[0] * sums[i];
  for (int k = 1; k <= band.half_width; ++k) {
    precise float pair = 0.0;
    if (x >= k) pair += sums[i - k];
    if (x + k < band.width) pair += sums[i + k];
    sum += band.relative[k] * pair;
  }
  precise float cost = band.energy_gain * energy(y, band.height);
  cost *= energy(x, band.width);
  precise float value = sum * band.gain + cost;
  map[i] = value;
}

void count_hits() {
  int span = int(item()), last = min((span + 1) * kSpan, pixels());
  if (span * kSpan >= pixels()) return;
  uint count = 0u;
  for (int i = span * kSpan; i < last; ++i) count += map[i] > band.threshold ? 1u : 0u;
  counts[span] = count;
}

// Hits row by row, left to right, after those of earlier spans.
void collect_hits() {
  int span = int(item()), last = min((span + 1) * kSpan, pixels());
  if (span * kSpan >= pixels()) return;
  uint next = counts[span];
  for (int i = span * kSpan; i < last; ++i) {
    if (!(map[i] > band.threshold)) continue;
    hits[next] = Hit(i % band.width, band.first + i / band.width, map[i]);
    ++next;
  }
}

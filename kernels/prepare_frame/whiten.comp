// SPDX-License-Identifier: Apache-2.0
// z, the residual over its noise sigma. A ring's energies are whole numbers, so that their sums,
// along rows and then down columns, are exact.
#include "glint/kernels/core/prelude.glsl"
#include "glint/kernels/prepare_frame/keys.glsl"
#include "glint/kernels/prepare_frame/pass.glsl"

layout(std430, binding = 0) readonly buffer Parameters { WhitenBand band; };
layout(std430, binding = 1) readonly buffer Image { float image[]; };
layout(std430, binding = 2) readonly buffer Background { float background[]; };
layout(std430, binding = 3) readonly buffer Structure { float structure[]; };  // rows made
layout(std430, binding = 4) buffer Energies { uint energies[]; };
layout(std430, binding = 5) buffer Rings { Ring rings[]; };
layout(std430, binding = 6) writeonly buffer Whitened { float whitened[]; };  // rows made
layout(std430, binding = 7) writeonly buffer Noise { float noises[]; };

const uint kNoEnergy = 0xffffffffu;

float residual(int i) {
  precise float r = image[i] - background[i];
  return r;
}

void energy() {
  int i = int(item());
  if (i >= band.width * (band.bottom - band.top)) return;
  precise float r = residual(i) * band.inverse_sigma;
  precise float e = r * r * band.energy_scale;
  precise float rounded = min(e, band.energy_cap) + 0.5;
  energies[i] = is_nan(r) ? kNoEnergy : uint(rounded);
}

// Sums of both boxes along a row.
void along() {
  int i = int(item());
  if (i >= band.width * (band.bottom - band.top)) return;
  int x = i % band.width;
  Ring sums = Ring(0u, 0u, 0u);
  for (int k = -band.outer; k <= band.outer; ++k) {
    if (x + k < 0 || x + k >= band.width) continue;
    uint e = energies[i + k];
    bool is_inner = abs(k) <= band.inner, known = e != kNoEnergy;
    sums.outer += known ? e : 0u;
    sums.inner += known && is_inner ? e : 0u;
    sums.known += known ? (is_inner ? 0x10001u : 1u) : 0u;
  }
  rings[i] = sums;
}

// Root mean square of the ring's residuals [sigma], 0 without any.
float ring_at(int x, int y) {
  uint sum = 0u, count = 0u;
  for (int k = -band.outer; k <= band.outer; ++k) {
    if (y + k < 0 || y + k >= band.height) continue;
    Ring row = rings[(y + k - band.top) * band.width + x];
    bool is_inner = abs(k) <= band.inner;
    sum += row.outer - (is_inner ? row.inner : 0u);
    count += (row.known & 0xffffu) - (is_inner ? row.known >> 16 : 0u);
  }
  precise float factor = 1.0 / (float(max(count, 1u)) * band.energy_scale);
  precise float rms = sqrt(float(sum) * factor);
  return count > 0u ? rms : 0.0;
}

float noise_at(int x, int y, int i) {
  float noise = band.sigma;
  if (band.outer > 0) {
    precise float ring = band.sigma * ring_at(x, y);
    noise = max(noise, ring);
  }
  return band.structured != 0u ? max(noise, structure[i]) : noise;
}

// Noises are kept row by row of those that the step picks.
void keep_noise(int x, int y, float noise) {
  if (band.noise_step == 0 || x % band.noise_step != 0 || y % band.noise_step != 0) return;
  int columns = (band.width + band.noise_step - 1) / band.noise_step;
  int first_row = (band.first + band.noise_step - 1) / band.noise_step;
  noises[(y / band.noise_step - first_row) * columns + x / band.noise_step] = noise;
}

void whiten() {
  int i = int(item());
  if (i >= band.width * (band.last - band.first)) return;
  int x = i % band.width, y = band.first + i / band.width;
  float r = residual((y - band.top) * band.width + x);
  float noise = noise_at(x, y, i);
  float turned = intBitsToFloat((floatBitsToInt(r) & band.keep_bits) ^ band.flip_bits);
  precise float z = turned / noise - band.offset;
  whitened[i] = is_nan(r) ? 0.0 : clamp(z, band.clip_low, band.clip_high);
  keep_noise(x, y, is_nan(r) ? uintBitsToFloat(0x7fc00000u) : noise);
}

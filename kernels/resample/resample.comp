// SPDX-License-Identifier: Apache-2.0
// Ancestors by the formulas of shares.hpp, in double and of whole numbers, so that they are exact:
// sums of chunks, which the host turns into the sums before them; how many offspring come before
// each particle; and for each offspring, the last particle that no more than its number come
// before.
#include "glint/kernels/core/prelude.glsl"
#include "glint/kernels/resample/pass.glsl"

layout(std430, binding = 0) readonly buffer Parameters { DrawPass pass; };
layout(std430, binding = 1) readonly buffer Weights { uint weights[]; };
layout(std430, binding = 2) buffer Largest { uint largest[]; };
layout(std430, binding = 3) buffer Sums { double sums[]; };  // copies and mass of each chunk
layout(std430, binding = 4) buffer Before { int before[]; };
layout(std430, binding = 5) buffer Ancestors { uint ancestors[]; };
layout(std430, binding = 6) readonly buffer Source { uint source[]; };
layout(std430, binding = 7) writeonly buffer Destination { uint destination[]; };

double wide(uint words[2]) { return packDouble2x32(uvec2(words[0], words[1])); }

uint chunks() { return (pass.particles + kChunk - 1u) / kChunk; }
uint chunk_end(uint chunk) { return min(pass.particles, (chunk + 1u) * kChunk); }

// valid() on the bits of a weight.
uint valid(uint bits) {
  if (bits > 0x7f800000u) return 0u;  // negative or NaN
  return min(bits, 0x7f7fffffu);
}

// The float of these bits; by hand, as some devices take denormal floats for 0.
double exactly(uint bits) {
  if (bits >= 0x00800000u) return double(uintBitsToFloat(bits));
  return double(bits) * packDouble2x32(uvec2(0u, 0x36a00000u));  // 2^-149
}

int whole(uint i) {
  precise double scaled = exactly(valid(weights[i])) * wide(pass.factor) + wide(pass.offset);
  return int(scaled);
}

int below(double mass) {
  precise double points = mass * wide(pass.rate) + wide(pass.lead);
  return int(points);
}

struct Split {
  int copies, remainder;
};

Split split(int whole) {
  if (pass.splits == 0u) return Split(0, whole);
  precise double total = wide(pass.total);
  precise double product = wide(pass.count) * double(whole);
  precise double quotient = product * wide(pass.inverse);
  int guess = int(quotient);
  precise double rest = product - double(guess) * total;
  int low = rest < 0.0lf ? 1 : 0, high = rest >= total ? 1 : 0;
  precise double fraction = rest + double(low - high) * total;
  precise double remainder = fraction * wide(pass.remainder_factor);
  return Split(guess - low + high, int(remainder));
}

void find_largest() {
  uint chunk = item(), found = 0u;
  if (chunk >= chunks()) return;
  for (uint i = chunk * kChunk; i < chunk_end(chunk); ++i) found = max(found, valid(weights[i]));
  largest[chunk] = found;
}

void add_up() {
  uint chunk = item();
  if (chunk >= chunks()) return;
  double copies = 0.0lf, mass = 0.0lf;
  for (uint i = chunk * kChunk; i < chunk_end(chunk); ++i) {
    Split s = split(whole(i));
    copies += double(s.copies);
    mass += double(s.remainder);
  }
  sums[2u * chunk] = copies;
  sums[2u * chunk + 1u] = mass;
}

void count_before() {
  uint chunk = item();
  if (chunk >= chunks()) return;
  double copies = sums[2u * chunk], mass = sums[2u * chunk + 1u];
  for (uint i = chunk * kChunk; i < chunk_end(chunk); ++i) {
    before[i] = int(copies) + below(mass);
    Split s = split(whole(i));
    copies += double(s.copies);
    mass += double(s.remainder);
  }
}

void draw() {
  uint j = item();
  if (j >= pass.offspring) return;
  uint low = 0u, high = pass.particles;  // before[low] <= j
  while (high - low > 1u) {
    uint middle = (low + high) / 2u;
    if (before[middle] <= int(j)) low = middle;
    else high = middle;
  }
  ancestors[j] = low;
}

void gather() {
  uint j = item();
  if (j >= pass.offspring) return;
  destination[j] = source[ancestors[j]];
}

// SPDX-License-Identifier: Apache-2.0
// Counts to the sums of those before them: within blocks, whose sums are treated alike, and then
// across them.
#include "glint/kernels/core/prelude.glsl"
#include "glint/kernels/core/scan.glsl"

layout(std430, binding = 0) readonly buffer Parameters { ScanPass pass; };
layout(std430, binding = 1) buffer Counts { uint counts[]; };
layout(std430, binding = 2) buffer Sums { uint sums[]; };  // of blocks; later, of those before

void within_blocks() {
  uint block = item(), sum = 0u;
  if (block * kScanBlock >= pass.count) return;
  for (uint i = block * kScanBlock; i < min(pass.count, (block + 1u) * kScanBlock); ++i) {
    uint count = counts[i];
    counts[i] = sum;
    sum += count;
  }
  sums[block] = sum;
}

void across_blocks() {
  uint i = item();
  if (i < pass.count) counts[i] += sums[i / kScanBlock];
}

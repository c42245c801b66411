// SPDX-License-Identifier: Apache-2.0
// A stable sort of the particles by cell, a digit a pass, and the runs of equal cells. No atomics:
// chunks are counted, the counts summed up, and each chunk writes from its own place on.
#include "glint/kernels/core/prelude.glsl"
#include "glint/kernels/cell_weights/pass.glsl"

layout(std430, binding = 0) readonly buffer Parameters { CellPass pass; };
layout(std430, binding = 1) readonly buffer Keys { uint keys[]; };
layout(std430, binding = 2) buffer Counts { uint counts[]; };
layout(std430, binding = 3) readonly buffer Items { uint items[]; };
layout(std430, binding = 4) writeonly buffer SortedKeys { uint sorted_keys[]; };
layout(std430, binding = 5) writeonly buffer SortedItems { uint sorted_items[]; };

uint chunks() { return (pass.count + kChunk - 1u) / kChunk; }
uint chunk_end(uint chunk) { return min(pass.count, (chunk + 1u) * kChunk); }
uint digit(uint key) { return (key >> pass.shift) % kDigits; }

void count_digits() {
  uint chunk = item(), count[kDigits];
  if (chunk >= chunks()) return;
  for (uint d = 0u; d < kDigits; ++d) count[d] = 0u;
  for (uint k = chunk * kChunk; k < chunk_end(chunk); ++k) ++count[digit(keys[k])];
  for (uint d = 0u; d < kDigits; ++d) counts[d * chunks() + chunk] = count[d];
}

void sort() {
  uint chunk = item(), next[kDigits];
  if (chunk >= chunks()) return;
  for (uint d = 0u; d < kDigits; ++d) next[d] = counts[d * chunks() + chunk];
  for (uint k = chunk * kChunk; k < chunk_end(chunk); ++k) {
    uint to = next[digit(keys[k])]++;
    sorted_keys[to] = keys[k];
    sorted_items[to] = pass.shift == 0u ? k : items[k];
  }
}

bool is_inside(uint k) { return keys[k] < uint(pass.width) * uint(pass.height); }
bool starts_run(uint k) { return is_inside(k) && (k == 0u || keys[k] != keys[k - 1u]); }

// Runs of a chunk into counts, particles in the frame into sorted_keys.
void count_runs() {
  uint chunk = item(), starts = 0u, inside = 0u;
  if (chunk >= chunks()) return;
  for (uint k = chunk * kChunk; k < chunk_end(chunk); ++k) {
    inside += is_inside(k) ? 1u : 0u;
    starts += starts_run(k) ? 1u : 0u;
  }
  counts[chunk] = starts;
  sorted_keys[chunk] = inside;
}

// Cells of runs into sorted_keys, first places into sorted_items.
void write_runs() {
  uint chunk = item();
  if (chunk >= chunks()) return;
  uint run = counts[chunk];
  for (uint k = chunk * kChunk; k < chunk_end(chunk); ++k) {
    if (!starts_run(k)) continue;
    sorted_keys[run] = keys[k];
    sorted_items[run] = k;
    ++run;
  }
}

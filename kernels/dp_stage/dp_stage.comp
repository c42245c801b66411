// SPDX-License-Identifier: Apache-2.0
// One stage of the dynamic program: the best predecessor of every cell. Moves are bytes, four cells a
// word; best_moves holds dx in the low byte and dy in the next of a cell's own word.
#include "glint/kernels/core/prelude.glsl"
#include "glint/kernels/dp_stage/pass.glsl"

layout(std430, binding = 0) readonly buffer Parameters { StageBand band; };
layout(std430, binding = 1) readonly buffer Score { float score[]; };
layout(std430, binding = 2) readonly buffer Before { float before[]; };
layout(std430, binding = 3) readonly buffer MovesX { int moves_x[]; };
layout(std430, binding = 4) readonly buffer MovesY { int moves_y[]; };
layout(std430, binding = 5) writeonly buffer Total { float total[]; };
layout(std430, binding = 6) buffer Best { uint best_moves[]; };
layout(std430, binding = 7) writeonly buffer BestX { uint best_x[]; };
layout(std430, binding = 8) writeonly buffer BestY { uint best_y[]; };

bool may_follow(int at, int dx, int dy) {
  if (band.follows == 0u) return true;
  int shift = 8 * (at & 3);
  return abs(dx - bitfieldExtract(moves_x[at >> 2], shift, 8)) <= band.tolerance &&
         abs(dy - bitfieldExtract(moves_y[at >> 2], shift, 8)) <= band.tolerance;
}

void stage() {
  int i = int(item());
  if (i >= band.width * (band.last - band.first)) return;
  int x = i % band.width, y = band.first + i / band.width;
  precise float best = uintBitsToFloat(0xff800000u);
  int best_dx = 0, best_dy = 0;
  for (int dy = -band.reach; dy <= band.reach; ++dy) {
    if (y - dy < 0 || y - dy >= band.height) continue;
    int row = (y - dy - band.top) * band.width;
    for (int dx = -band.reach; dx <= band.reach; ++dx) {
      if (x - dx < 0 || x - dx >= band.width) continue;
      float value = before[row + x - dx];
      if (!(value > best) || !may_follow(row + x - dx, dx, dy)) continue;
      best = value, best_dx = dx, best_dy = dy;
    }
  }
  precise float sum = score[i] + best;
  total[i] = sum;
  best_moves[i] = uint((best_dx & 0xff) | (best_dy & 0xff) << 8);
}

// From a word a cell to bytes.
void split() {
  uint word = item(), cells = uint(band.width * (band.last - band.first));
  if (4u * word >= cells) return;
  uint x = 0u, y = 0u;
  for (uint k = 0u; k < 4u && 4u * word + k < cells; ++k) {
    uint move = best_moves[4u * word + k];
    x |= (move & 0xffu) << 8u * k;
    y |= (move >> 8u) << 8u * k;
  }
  best_x[word] = x;
  best_y[word] = y;
}

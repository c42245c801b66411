// SPDX-License-Identifier: Apache-2.0
// One stage of the dynamic program: the best predecessor of every cell. Moves are bytes, dx in the
// low one and dy in the next of a word.
#include "glint/kernels/core/prelude.glsl"
#include "glint/kernels/dp_stage/pass.glsl"

layout(std430, binding = 0) readonly buffer Parameters { StageBand band; };
layout(std430, binding = 1) readonly buffer Score { float score[]; };
layout(std430, binding = 2) readonly buffer Before { float before[]; };
layout(std430, binding = 3) readonly buffer Moves { int moves[]; };
layout(std430, binding = 4) writeonly buffer Total { float total[]; };
layout(std430, binding = 5) writeonly buffer Best { int best_moves[]; };

bool may_follow(int at, int dx, int dy) {
  if (band.follows == 0u) return true;
  int move = moves[at];
  return abs(dx - bitfieldExtract(move, 0, 8)) <= band.tolerance &&
         abs(dy - bitfieldExtract(move, 8, 8)) <= band.tolerance;
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
  best_moves[i] = (best_dx & 0xff) | (best_dy & 0xff) << 8;
}

// SPDX-License-Identifier: Apache-2.0
// A cell within reach of each given one, in proportion to the scores there.
#include "glint/kernels/core/prelude.glsl"
#include "glint/kernels/pick_cells/pass.glsl"

layout(std430, binding = 0) readonly buffer Parameters { PickPass pass; };
layout(std430, binding = 1) readonly buffer Score { float scores[]; };
layout(std430, binding = 2) readonly buffer Cell { uint cells[]; };
layout(std430, binding = 3) readonly buffer Uniform { float uniforms[]; };
layout(std430, binding = 4) writeonly buffer Picked { uint picked[]; };
layout(std430, binding = 5) writeonly buffer PickedScore { float picked_scores[]; };
layout(std430, binding = 6) writeonly buffer Total { double totals[]; };

float score(int x, int y) { return scores[(y - pass.top) * pass.width + x]; }

double row_sum(int y, int x0, int x1) {
  precise double sum = 0.0lf;
  for (int x = x0; x <= x1; ++x) sum += double(score(x, y));
  return sum;
}

void pick() {
  uint i = item();
  if (i >= pass.count) return;
  int column = int(cells[i] % uint(pass.width)), row = int(cells[i] / uint(pass.width));
  if (row < pass.first || row >= pass.last) return;
  int x0 = max(0, column - pass.reach), x1 = min(pass.width - 1, column + pass.reach);
  int y0 = max(0, row - pass.reach), y1 = min(pass.height - 1, row + pass.reach);
  precise double total = 0.0lf;
  for (int y = y0; y <= y1; ++y) total += row_sum(y, x0, x1);
  precise double left = double(uniforms[i]) * total;
  int y = y0;
  for (double s = row_sum(y, x0, x1); y < y1 && left >= s; s = row_sum(y, x0, x1)) {
    left -= s;
    ++y;
  }
  int x = x0;
  for (; x < x1 && left >= double(score(x, y)); ++x) left -= double(score(x, y));
  picked[i] = uint(y) * uint(pass.width) + uint(x);
  picked_scores[i] = score(x, y);
  totals[i] = total;
}

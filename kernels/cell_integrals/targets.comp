// SPDX-License-Identifier: Apache-2.0
// Adds rows to their targets' sums, from top to bottom. P-HPMHT (10), (11), (17), (18)
#include "glint/kernels/core/prelude.glsl"
#include "glint/kernels/cell_integrals/pass.glsl"

layout(std430, binding = 0) readonly buffer Parameters { CellBand band; };
layout(std430, binding = 1) readonly buffer Windows { Window windows[]; };
layout(std430, binding = 2) readonly buffer Axes { AxisCell axes[]; };
layout(std430, binding = 3) readonly buffer Rows { WindowRow rows[]; };
layout(std430, binding = 4) readonly buffer Sums { RowSums sums[]; };
layout(std430, binding = 5) readonly buffer Runs { RowRun runs[]; };
layout(std430, binding = 6) buffer Targets { WindowSums targets[]; };

void add_rows() {
  uint i = item();
  if (i >= band.items) return;
  RowRun run = runs[i];
  Window w = windows[run.target];
  WindowSums t = targets[run.target];
  for (uint r = run.first; r < run.end; ++r) {
    RowSums s = sums[r];
    AxisCell row = axes[w.columns + uint(w.x1 - w.x0 + rows[r].y - w.y0)];
    double p = double(row.p), first = double(row.first), second = double(row.second);
    t.count += p * double(s.p);
    t.x += p * double(s.first);
    t.y += first * double(s.p);
    t.xx += p * double(s.second);
    t.yy += second * double(s.p);
    t.missing += p * double(s.missing_p);
    t.missing_x += p * double(s.missing_first);
    t.missing_y += first * double(s.missing_p);
    t.missing_xx += p * double(s.missing_second);
    t.missing_yy += second * double(s.missing_p);
    t.log_ratio += double(s.log_ratio);
  }
  targets[run.target] = t;
}

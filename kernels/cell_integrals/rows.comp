// SPDX-License-Identifier: Apache-2.0
// Sums over one row of a target's window. P-HPMHT (7), (10), (11), (17), (18)
#include "glint/kernels/core/prelude.glsl"
#include "glint/kernels/core/glsl.glsl"
#include "glint/kernels/core/math.glsl"
#include "glint/kernels/cell_integrals/pass.glsl"

layout(std430, binding = 0) readonly buffer Parameters { CellBand band; };
layout(std430, binding = 1) readonly buffer Frame { float frame[]; };
layout(std430, binding = 2) readonly buffer Boxes { ivec4 boxes[]; };
layout(std430, binding = 3) readonly buffer Windows { Window windows[]; };
layout(std430, binding = 4) readonly buffer Neighbours { uint neighbours[]; };
layout(std430, binding = 5) readonly buffer Axes { AxisCell axes[]; };
layout(std430, binding = 6) readonly buffer Rows { WindowRow rows[]; };
layout(std430, binding = 7) writeonly buffer Sums { RowSums sums[]; };
#include "glint/kernels/cell_integrals/pixels.glsl"

bool covers(Window w, int x, int y) { return x >= w.x0 && x < w.x1 && y >= w.y0 && y < w.y1; }

// pi_k P_kl.
float share(Window w, int x, int y) {
  uint column = w.columns + uint(x - w.x0), row = w.columns + uint(w.x1 - w.x0 + y - w.y0);
  precise float share = w.proportion * axes[column].p * axes[row].p;
  return share;
}

struct Mixture {
  float p;   // P_l
  bool own;  // whether the cell counts for this target in the log-likelihood
};
// The mixture is that of the target's own share, then its neighbours' in their order; a cell counts
// for the first target whose window has it.
Mixture mixture_at(Window w, uint target, int x, int y) {
  precise float p = band.background + share(w, x, y);
  bool own = true;
  for (uint i = w.first_neighbour; i < w.end_neighbour; ++i) {
    uint neighbour = neighbours[i];
    Window other = windows[neighbour];
    bool meets = covers(other, x, y);
    if (meets) p += share(other, x, y);
    own = own && !(meets && neighbour < target);
  }
  return Mixture(p, own);
}

void sum_row() {
  uint i = item();
  if (i >= band.items) return;
  WindowRow row = rows[i];
  Window w = windows[row.target];
  precise float p = 0.0, first = 0.0, second = 0.0;
  precise float missing_p = 0.0, missing_first = 0.0, missing_second = 0.0, log_ratio = 0.0;
  for (int x = w.x0; x < w.x1; ++x) {
    float pixel = frame[(row.y - band.first) * band.width + x];
    bool missing = is_missing(pixel, x, row.y);
    Mixture mixture = mixture_at(w, row.target, x, row.y);
    AxisCell column = axes[w.columns + uint(x - w.x0)];
    precise float z = missing ? 0.0 : intensity(pixel);
    precise float weight = z / mixture.p, hidden = missing ? 1.0 : 0.0;
    p += weight * column.p;
    first += weight * column.first;
    second += weight * column.second;
    missing_p += hidden * column.p;
    missing_first += hidden * column.first;
    missing_second += hidden * column.second;
    if (band.log_likelihood != 0u && mixture.own) {
      log_ratio += z * log(mixture.p / band.background);
    }
  }
  sums[i] = RowSums(p, first, second, missing_p, missing_first, missing_second, log_ratio);
}

// SPDX-License-Identifier: Apache-2.0
// Integrals of targets over the cells of one axis. P-HPMHT (6), (10), (17)
#include "glint/kernels/core/prelude.glsl"
#include "glint/kernels/core/glsl.glsl"
#include "glint/kernels/core/math.glsl"
#include "glint/kernels/cell_integrals/erfcx.glsl"
#include "glint/kernels/cell_integrals/pass.glsl"

layout(std430, binding = 0) readonly buffer Parameters { CellBand band; };
layout(std430, binding = 1) readonly buffer Windows { Window windows[]; };
layout(std430, binding = 2) writeonly buffer Axes { AxisCell axes[]; };
layout(std430, binding = 3) writeonly buffer Totals { double totals[]; };

// exp(x^2) erfc(x) / 2 for 0 <= x <= kFarthest.
float half_erfcx(float x) {
  precise float grow = fma(2.0, x, 1.0), shift = x + 2.0;
  precise float inverse = 1.0 / (grow * shift);
  precise float t = (x - 2.0) * grow * inverse;
  precise float p = kErfcx[0];
  for (int i = 1; i < kErfcxTerms; ++i) p = fma(p, t, kErfcx[i]);
  precise float result = p * shift * inverse;
  return result;
}

// An edge: distance from the mean, probability beyond it on its far side from the mean, and sigma^2
// times the density.
struct Edge {
  float u, tail, density;
};
Edge edge_at(float u, float sigma) {
  precise float v = u * (0.707106781 / sigma);
  precise float x = min(abs(v), kFarthest);
  precise float e = exp(-(x * x));
  precise float tail = e * half_erfcx(x), density = e * (0.398942280 * sigma);
  return Edge(u, tail, density);
}

// Differences of tails are taken on their small side, and moments are kept inside the cell, which
// cancellation could leave far out.
AxisCell cell_between(Edge a, Edge b, float sigma) {
  bool right = a.u >= 0.0, left = b.u <= 0.0;
  precise float p = right ? a.tail - b.tail : left ? b.tail - a.tail : 1.0 - a.tail - b.tail;
  precise float p_a = p * a.u, p_b = p * b.u, low = p_a * a.u, high = p_b * b.u;
  precise float first = a.density - b.density;
  precise float second = fma(sigma * sigma, p, a.u * a.density - b.u * b.density);
  float near = right || left ? min(low, high) : 0.0;
  bool any = p > 0.0;
  return AxisCell(p, any ? clamp(first, p_a, p_b) : 0.0,
                  any ? clamp(second, near, max(low, high)) : 0.0);
}

// Columns of target i / 2 for even i, its rows for odd i.
void integrate() {
  uint i = item();
  if (i >= band.items) return;
  Window w = windows[i / 2u];
  bool rows = (i & 1u) != 0u;
  int n = rows ? w.y1 - w.y0 : w.x1 - w.x0;
  uint to = rows ? w.columns + uint(w.x1 - w.x0) : w.columns;
  float sigma = rows ? w.sigma_y : w.sigma_x, from = rows ? w.top : w.left;
  Edge edge = edge_at(from, sigma);
  precise double total = 0.0lf;
  for (int k = 0; k < n; ++k) {
    precise float u = from + float(k + 1);
    Edge next = edge_at(u, sigma);
    AxisCell cell = cell_between(edge, next, sigma);
    axes[to + uint(k)] = cell;
    total += double(cell.p);
    edge = next;
  }
  totals[i] = total;
}

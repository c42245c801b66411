// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/kernels/cell_integrals/lanes.hpp"
#include "glint/kernels/cell_integrals/wide.hpp"
#include "glint/kernels/core/math.hpp"

// Part of lanes.cpp: a target's cell integrals along one axis. Probabilities and moments of a cell
// are products of two of them. P-HPMHT (6), (10), (17)
namespace glint::GLINT_LANES {
namespace {

/// exp(x^2) erfc(x) / 2 for 0 <= x <= 9.4, relative error 1.3e-8 before rounding.
GLINT_INLINE float half_erfcx(float x) {
  const float grow = math::fma(2.0f, x, 1.0f), shift = x + 2.0f;
  const float inverse = 1.0f / (grow * shift);
  const float t = (x - 2.0f) * grow * inverse;
  float p = -2.071963172e-04f;
  p = math::fma(p, t, -6.254414709e-04f);
  p = math::fma(p, t, 6.597990050e-04f);
  p = math::fma(p, t, 4.324845240e-03f);
  p = math::fma(p, t, -4.029633391e-03f);
  p = math::fma(p, t, -2.710463746e-02f);
  p = math::fma(p, t, 8.202748382e-02f);
  p = math::fma(p, t, -8.301548555e-02f);
  p = math::fma(p, t, -4.638198070e-02f);
  p = math::fma(p, t, 6.384891934e-01f);
  return p * shift * inverse;
}

/// Sixteen edges of cells: distance from the mean, probability beyond the edge on its far side from
/// the mean, and sigma^2 times the density.
struct Edges {
  Wide u, tail, density;
};
GLINT_INLINE Edges edges_from(float first, float sigma) {
  alignas(64) float u[16], tail[16], density[16];
  const float scale = 0.707106781f / sigma, peak = 0.398942280f * sigma;
  for (int i = 0; i < 16; ++i) {
    u[i] = first + static_cast<float>(i);
    const float v = u[i] * scale, magnitude = v < 0 ? -v : v;
    const float x = magnitude < 9.4f ? magnitude : 9.4f;
    const float e = math::exp(-(x * x));
    tail[i] = e * half_erfcx(x);
    density[i] = e * peak;
  }
  return {load_wide(u), load_wide(tail), load_wide(density)};
}

struct Cells {
  Wide p, first, second;
};
/// Integrals of `n` cells, zeros beyond; `next` holds the edges one further. Differences of tails
/// are taken on their small side, and moments are kept inside the cell.
GLINT_INLINE Cells cells_between(const Edges& at, const Edges& next, float sigma, int n) {
  Cells c;
  for (int k = 0; k < kParts; ++k) {
    const Part a = at.u.part[k], b = next.u.part[k];
    const Part ta = at.tail.part[k], tb = next.tail.part[k];
    const Part da = at.density.part[k], db = next.density.part[k];
    const auto right = a >= 0.0f, left = b <= 0.0f;
    Part p = where(right, ta - tb, where(left, tb - ta, 1.0f - ta - tb));
    p = where(count_from<kLanes>(k * kLanes) < n, p);
    const Part pa = p * a, pb = p * b, low = pa * a, high = pb * b;
    const Part first = bounded(da - db, pa, pb);
    const Part second = fma(broadcast<Part>(sigma * sigma), p, a * da - b * db);
    const Part near = where((right | left), lesser(low, high));
    c.p.part[k] = p;
    c.first.part[k] = where(p > 0.0f, first);
    c.second.part[k] = where(p > 0.0f, bounded(second, near, greater(low, high)));
  }
  return c;
}

GLINT_INLINE AxisProfile axis_profile(float first, float sigma, int n, float* storage) {
  float* const p = storage + kProfilePad;
  float* const first_moment = p + padded(n) + kProfilePad;
  float* const second_moment = first_moment + padded(n);
  store_wide(storage, zero());
  store_wide(p + padded(n), zero());
  Edges edges = edges_from(first, sigma), further = edges;
  for (int i = 0; i < n; i += 16) {
    const bool last = n - i < 16;  // no cell needs an edge of the next sixteen
    if (!last) further = edges_from(first + static_cast<float>(i + 16), sigma);
    const Edges next{one_on(edges.u, further.u), one_on(edges.tail, further.tail),
                     one_on(edges.density, further.density)};
    const Cells c = cells_between(edges, next, sigma, n - i);
    store_wide(p + i, c.p);
    store_wide(first_moment + i, c.first);
    store_wide(second_moment + i, c.second);
    edges = further;
  }
  return {p, first_moment, second_moment};
}

/// The cells of a window of at most kIsolatedSide pixels on one axis.
GLINT_INLINE Cells few_cells(float first, float sigma, int n) {
  const Edges edges = edges_from(first, sigma);
  const Edges next{one_on(edges.u), one_on(edges.tail), one_on(edges.density)};
  return cells_between(edges, next, sigma, n);
}

}  // namespace
}  // namespace glint::GLINT_LANES

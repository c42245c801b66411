// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/kernels/cell_integrals/lanes.hpp"
#include "glint/kernels/cell_integrals/wide.hpp"
#include "glint/kernels/core/math.hpp"

// Part of lanes.cpp: a target's cell integrals along one axis. Probabilities and moments of a cell
// are products of two of them. P-HPMHT (6), (10), (17)
namespace glint::GLINT_LANES {
namespace {

#include "glint/kernels/cell_integrals/erfcx.glsl"

/// exp(x^2) erfc(x) / 2 for 0 <= x <= kFarthest.
GLINT_INLINE Part half_erfcx(Part x) {
  const Part one = broadcast<Part>(1.0f);
  const Part grow = fma(broadcast<Part>(2.0f), x, one), shift = x + 2.0f;
  const Part inverse = one / (grow * shift);
  const Part t = (x - 2.0f) * grow * inverse;
  Part p = broadcast<Part>(kErfcx[0]);
  for (int i = 1; i < kErfcxTerms; ++i) p = fma(p, t, broadcast<Part>(kErfcx[i]));
  return p * shift * inverse;
}

GLINT_INLINE Part exp_each(Part x) {
  float values[kLanes];
  store(values, x);
  for (float& value : values) value = math::exp(value);
  return load<kLanes>(values);
}

/// Sixteen edges of cells: distance from the mean, probability beyond the edge on its far side from
/// the mean, and sigma^2 times the density.
struct Edges {
  Wide u, tail, density;
};
GLINT_INLINE Edges edges_from(float first, float sigma) {
  const float scale = 0.707106781f / sigma, peak = 0.398942280f * sigma;
  Edges edges;
  for (int k = 0; k < kParts; ++k) {
    const Part u = __builtin_convertvector(count_from<kLanes>(k * kLanes), Part) + first;
    const Part v = u * scale;
    const Part x = lesser(greater(v, -v), broadcast<Part>(kFarthest));
    const Part e = exp_each(-(x * x));
    edges.u.part[k] = u;
    edges.tail.part[k] = e * half_erfcx(x);
    edges.density.part[k] = e * peak;
  }
  return edges;
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

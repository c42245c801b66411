// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/kernels/core/math.hpp"
#include "glint/kernels/prepare_frame/lanes.hpp"

// Part of lanes.cpp: rows of one frame against another that is shifted. Sums run in kSums fixed
// lanes whatever the instruction set.
namespace glint::GLINT_LANES {
namespace {

constexpr int kSums = 16;

/// The moving frame as row y of the reference sees it.
struct MovedRow {
  const float *upper, *lower;  ///< null if the row lies outside
  int first, last;             ///< columns that it covers
  int next;                    ///< 1 where the right neighbour counts
  float ax, ay;

  GLINT_INLINE explicit MovedRow(const ShiftPass& p, int y)
      : upper(nullptr),
        lower(nullptr),
        first(0),
        last(0),
        next(p.ax > 0 ? 1 : 0),
        ax(p.ax),
        ay(p.ay) {
    const int v = y + p.iy, below = p.ay > 0 ? 1 : 0;
    if (v < 0 || v + below >= p.height) return;
    upper = p.moving + v * p.moving_pitch + p.ix;
    lower = upper + below * p.moving_pitch;
    first = p.ix < 0 ? -p.ix : 0;
    last = p.width - next - p.ix < p.width ? p.width - next - p.ix : p.width;
    if (last <= first) upper = nullptr;
  }
  GLINT_INLINE float at(int x) const {
    const float top = math::fma(ax, upper[x + next] - upper[x], upper[x]);
    const float bottom = math::fma(ax, lower[x + next] - lower[x], lower[x]);
    return math::fma(ay, bottom - top, top);
  }
};

struct Differences {
  float sum[kSums];
  std::int32_t count[kSums];
};

GLINT_INLINE void add_difference(const MovedRow& moved, const float* reference, int x, int lane,
                                 Differences& d) {
  const float difference = math::from_bits(math::bits(moved.at(x) - reference[x]) & 0x7fffffff);
  const bool known = difference == difference;
  d.sum[lane] += known ? difference : 0;
  d.count[lane] += known ? 1 : 0;
}

DifferenceSums difference_row(const ShiftPass& pass, int y) {
  const MovedRow moved(pass, y);
  if (moved.upper == nullptr) return {0, 0};
  const float* reference = pass.reference + y * pass.reference_pitch;
  Differences d{};
  int x = moved.first;
  for (; x + kSums <= moved.last; x += kSums) {
    for (int k = 0; k < kSums; ++k) add_difference(moved, reference, x + k, k, d);
  }
  for (int k = 0; x + k < moved.last; ++k) add_difference(moved, reference, x + k, k, d);
  DifferenceSums total{0, 0};
  for (int k = 0; k < kSums; ++k) {
    total.sum += static_cast<double>(d.sum[k]);
    total.count += d.count[k];
  }
  return total;
}

struct Equations {
  float xx[kSums], xy[kSums], yy[kSums], xe[kSums], ye[kSums];
};

GLINT_INLINE void add_equation(const MovedRow& moved, const float* reference, std::ptrdiff_t pitch,
                               int x, int k, Equations& s) {
  float gx = (reference[x + 1] - reference[x - 1]) * 0.5f;
  float gy = (reference[x + pitch] - reference[x - pitch]) * 0.5f;
  float e = moved.at(x) - reference[x];
  const float all = gx + gy + e;
  const bool known = all == all;
  gx = known ? gx : 0, gy = known ? gy : 0, e = known ? e : 0;
  s.xx[k] = math::fma(gx, gx, s.xx[k]);
  s.xy[k] = math::fma(gx, gy, s.xy[k]);
  s.yy[k] = math::fma(gy, gy, s.yy[k]);
  s.xe[k] = math::fma(gx, e, s.xe[k]);
  s.ye[k] = math::fma(gy, e, s.ye[k]);
}

/// Row y, 0 < y < height - 1.
EquationSums equations_row(const ShiftPass& pass, int y) {
  const MovedRow moved(pass, y);
  EquationSums total{};
  if (moved.upper == nullptr) return total;
  const float* reference = pass.reference + y * pass.reference_pitch;
  const int last = moved.last < pass.width - 1 ? moved.last : pass.width - 1;
  int x = moved.first > 1 ? moved.first : 1;
  Equations s{};
  for (; x + kSums <= last; x += kSums) {
    for (int k = 0; k < kSums; ++k) {
      add_equation(moved, reference, pass.reference_pitch, x + k, k, s);
    }
  }
  for (int k = 0; x + k < last; ++k) {
    add_equation(moved, reference, pass.reference_pitch, x + k, k, s);
  }
  for (int k = 0; k < kSums; ++k) {
    total.xx += static_cast<double>(s.xx[k]);
    total.xy += static_cast<double>(s.xy[k]);
    total.yy += static_cast<double>(s.yy[k]);
    total.xe += static_cast<double>(s.xe[k]);
    total.ye += static_cast<double>(s.ye[k]);
  }
  return total;
}

void shift_row(const ShiftPass& pass, float* out, int y) {
  const MovedRow moved(pass, y);
  const int first = moved.upper == nullptr ? pass.width : moved.first;
  const int last = moved.upper == nullptr ? pass.width : moved.last;
  for (int x = 0; x < first; ++x) out[x] = __builtin_nanf("");
  for (int x = first; x < last; ++x) out[x] = moved.at(x);
  for (int x = last; x < pass.width; ++x) out[x] = __builtin_nanf("");
}

void halve_row(const float* __restrict upper, const float* __restrict lower, float* __restrict half,
               int n) {
  for (int i = 0; i < n; ++i) {
    half[i] = 0.25f * ((upper[2 * i] + upper[2 * i + 1]) + (lower[2 * i] + lower[2 * i + 1]));
  }
}

}  // namespace
}  // namespace glint::GLINT_LANES

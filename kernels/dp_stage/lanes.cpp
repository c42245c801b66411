// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/dp_stage/lanes.hpp"

#include "glint/kernels/core/vectors.hpp"

namespace glint::GLINT_LANES {
namespace {

using F = Floats<kLanes>;
using I = Ints<kLanes>;
// Not `using`: g++ drops the attribute there.
typedef std::int8_t I8 __attribute__((vector_size(kLanes)));  // NOLINT(modernize-use-using)

/// The best path so far to kLanes cells in a row; the move is 256 dy + dx, dx as a byte.
struct Best {
  F total;
  I move;
};

/// kLanes elements from p[x]; at columns outside the frame the filler.
template <bool Edge, class V, class T>
GLINT_INLINE V cells(const T* p, int x, int width, T filler) {
  V v;
  if constexpr (Edge) {
    for (int i = 0; i < kLanes; ++i) v[i] = x + i >= 0 && x + i < width ? p[x + i] : filler;
  } else {
    __builtin_memcpy(&v, p + x, sizeof v);
  }
  return v;
}

/// Lanes whose last move is within the tolerance of `wanted`: 0 <= move - low <= 2 tolerance.
template <bool Edge>
GLINT_INLINE I within(const std::int8_t* moves, int x, int width, int wanted, int tolerance) {
  const I8 bytes = cells<Edge, I8, std::int8_t>(moves, x, width, 0);
  const I offset = __builtin_convertvector(bytes, I) - (wanted - tolerance);
  return (offset >= 0) & (offset <= 2 * tolerance);
}

template <bool Edge, bool Free>
GLINT_INLINE void try_row(const DpStage::Args& a, int x, int y, int dy, Best& best) {
  const float* const before = a.before.row(y - dy);
  const int width = a.score.width;
  for (int dx = -a.reach; dx <= a.reach; ++dx) {
    const F candidate = cells<Edge, F, float>(before, x - dx, width, -__builtin_inff());
    I better = candidate > best.total;
    if constexpr (!Free) {
      better &= within<Edge>(a.moves.dx.row(y - dy), x - dx, width, dx, a.tolerance) &
                within<Edge>(a.moves.dy.row(y - dy), x - dx, width, dy, a.tolerance);
    }
    best.total = where(better, candidate, best.total);
    best.move = where(better, broadcast<I>(dy * 256 + (dx & 255)), best.move);
  }
}

template <bool Edge, bool Free>
GLINT_INLINE void block(const DpStage::Args& a, int x, int y) {
  Best best{broadcast<F>(-__builtin_inff()), I{}};
  for (int dy = -a.reach; dy <= a.reach; ++dy) {
    if (y - dy >= 0 && y - dy < a.score.height) try_row<Edge, Free>(a, x, y, dy, best);
  }
  const F total = cells<Edge, F, float>(a.score.row(y), x, a.score.width, 0) + best.total;
  const I8 dx = __builtin_convertvector(best.move & 255, I8);
  const I8 dy = __builtin_convertvector(best.move >> 8, I8);
  if constexpr (Edge) {
    const int n = a.score.width - x < kLanes ? a.score.width - x : kLanes;
    for (int i = 0; i < n; ++i) {
      a.total.row(y)[x + i] = total[i];
      a.dx.row(y)[x + i] = dx[i], a.dy.row(y)[x + i] = dy[i];
    }
  } else {
    store(a.total.row(y) + x, total);
    store(a.dx.row(y) + x, dx);
    store(a.dy.row(y) + x, dy);
  }
}

template <bool Free>
void sweep(const DpStage::Args& a, int y0, int y1) {
  for (int y = y0; y < y1; ++y) {
    for (int x = 0; x < a.score.width; x += kLanes) {
      if (x >= a.reach && x + kLanes + a.reach <= a.score.width) {
        block<false, Free>(a, x, y);
      } else {
        block<true, Free>(a, x, y);
      }
    }
  }
}

void rows(const DpStage::Args& a, int y0, int y1) {
  if (a.moves.empty()) return sweep<true>(a, y0, y1);
  sweep<false>(a, y0, y1);
}

}  // namespace

extern const DpStageLanes dp_stage_lanes;
const DpStageLanes dp_stage_lanes{rows};

}  // namespace glint::GLINT_LANES

// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/dp_stage/lanes.hpp"

#include "glint/kernels/core/vectors.hpp"

namespace glint::GLINT_LANES {
namespace {

using F = Floats<kLanes>;
using I = Ints<kLanes>;
// Not `using`: g++ drops the attribute there.
typedef std::int8_t I8 __attribute__((vector_size(kLanes)));  // NOLINT(modernize-use-using)

/// The best path so far to kLanes cells in a row; the move is move_code()'s.
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
    best.move = where(better, broadcast<I>(move_code(dx, dy)), best.move);
  }
}

GLINT_INLINE I8 dx_of(const Best& best) { return __builtin_convertvector(best.move & 255, I8); }
GLINT_INLINE I8 dy_of(const Best& best) { return __builtin_convertvector(best.move >> 8, I8); }

GLINT_INLINE void put(const DpStage::Args& a, int x, int y, F score, const Best& best) {
  store(a.total.row(y) + x, score + best.total);
  store(a.dx.row(y) + x, dx_of(best));
  store(a.dy.row(y) + x, dy_of(best));
}
GLINT_INLINE void put_first(const DpStage::Args& a, int x, int y, F score, const Best& best,
                            int n) {
  const I8 dx = dx_of(best), dy = dy_of(best);
  store_first(a.total.row(y) + x, score + best.total, n);
  for (int i = 0; i < n; ++i) a.dx.row(y)[x + i] = dx[i], a.dy.row(y)[x + i] = dy[i];
}

template <bool Edge, bool Free>
GLINT_INLINE void block(const DpStage::Args& a, int x, int y) {
  Best best{broadcast<F>(-__builtin_inff()), I{}};
  for (int dy = -a.reach; dy <= a.reach; ++dy) {
    if (y - dy >= 0 && y - dy < a.score.height) try_row<Edge, Free>(a, x, y, dy, best);
  }
  const F score = cells<Edge, F, float>(a.score.row(y), x, a.score.width, 0);
  if constexpr (Edge) {
    put_first(a, x, y, score, best, a.score.width - x < kLanes ? a.score.width - x : kLanes);
  } else {
    put(a, x, y, score, best);
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

void refuse(const MoveRefusals& refusals, const std::int8_t* dx, const std::int8_t* dy, int n,
            std::int32_t* refused) {
  for (int x = 0; x < n; ++x) {
    refused[x] =
        refusals.x[static_cast<std::uint8_t>(dx[x])] | refusals.y[static_cast<std::uint8_t>(dy[x])];
  }
}

/// The best of one row of predecessors, `side` moves along x. Rows do not wait for each other.
GLINT_INLINE Best best_of_row(const float* values, const std::int32_t* refused,
                              const NearMove* moves, int side) {
  const F never = broadcast<F>(-__builtin_inff());
  Best best{never, I{}};
  for (int i = 0; i < side; ++i) {
    const I admitted = (load<kLanes>(refused - i) & moves[i].bits) == 0;
    const F candidate = admitted ? load<kLanes>(values - i) : never;
    best.move = candidate > best.total ? broadcast<I>(moves[i].code) : best.move;
    best.total = greater(best.total, candidate);
  }
  return best;
}

void near_row(const DpStage::Args& a, const NearRows& before, int y, int x0, int x1) {
  const int side = 2 * a.reach + 1;
  for (int x = x0; x < x1; x += kLanes) {
    Best best{broadcast<F>(-__builtin_inff()), I{}};
    for (int i = 0; i < side; ++i) {
      const int first = x - x0 + a.reach;  // where the move of the least dx comes from
      const Best row = best_of_row(before.values[i] + first, before.refused[i] + first,
                                   before.moves + i * side, side);
      best.move = row.total > best.total ? row.move : best.move;
      best.total = greater(best.total, row.total);
    }
    if (x1 - x >= kLanes) {
      put(a, x, y, load<kLanes>(a.score.row(y) + x), best);
    } else {
      put_first(a, x, y, load_first<kLanes>(a.score.row(y) + x, x1 - x), best, x1 - x);
    }
  }
}

}  // namespace

extern const DpStageLanes dp_stage_lanes;
const DpStageLanes dp_stage_lanes{rows, refuse, near_row};

}  // namespace glint::GLINT_LANES

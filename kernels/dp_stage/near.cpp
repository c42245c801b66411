// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/dp_stage/near.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "glint/kernels/core/tiles.hpp"
#include "glint/kernels/dp_stage/lanes.hpp"

namespace glint::dp_stage {
namespace {

using Args = DpStage::Args;

constexpr int kColumns = 512;
constexpr int kMaxSide = 2 * kNearReach + 1;

/// What depends on reach and tolerance only.
struct Moves {
  NearMove all[kMaxSide * kMaxSide];
  MoveRefusals refusals{};
};

Moves moves_of(int reach, int tolerance) {
  Moves moves;
  NearMove* move = moves.all;
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      *move++ = {1 << (dx + reach) | 1 << (dy + reach + 16), move_code(dx, dy)};
    }
  }
  for (int last = -128; last < 128; ++last) {
    std::int32_t bits = 0;
    for (int d = -reach; d <= reach; ++d) {
      if (std::abs(d - last) > tolerance) bits |= 1 << (d + reach);
    }
    moves.refusals.x[static_cast<std::uint8_t>(last)] = bits;
    moves.refusals.y[static_cast<std::uint8_t>(last)] = bits << 16;
  }
  return moves;
}

constexpr int kOutside = kMaxSide;  // slot of rows outside the frame

/// The rows of predecessors that a row of a tile may come from; row y is in slot y mod
/// (2 reach + 1).
struct Ring {
  alignas(64) float values[kMaxSide + 1][kColumns + 3 * kNearPad];
  alignas(64) std::int32_t refused[kMaxSide + 1][kColumns + 3 * kNearPad];
};

class Tile {
 public:
  Tile(const Args& args, const DpStageLanes& lanes, const Moves& moves, const Box& box)
      : args_(args), lanes_(lanes), moves_(moves), box_(box) {}

  void run() {
    clear(kOutside);
    for (int y = std::max(0, box_.y0 - args_.reach); y < box_.y0 + args_.reach; ++y) load(y);
    for (int y = box_.y0; y < box_.y1; ++y) {
      load(y + args_.reach);
      lanes_.near_row(args_, before(y), y, box_.x0, box_.x1);
    }
  }

 private:
  int slot(int y) const {
    return y >= 0 && y < args_.before.height ? y % (2 * args_.reach + 1) : kOutside;
  }

  void clear(int slot) {
    std::fill_n(ring_.values[slot], box_.x1 - box_.x0 + 3 * kNearPad,
                -std::numeric_limits<float>::infinity());
  }

  void load(int y) {
    if (y >= args_.before.height) return;
    const int begin = std::max(0, box_.x0 - args_.reach);
    const int end = std::min(args_.before.width, box_.x1 + args_.reach);
    const int place = kNearPad + begin - box_.x0;
    float* const values = ring_.values[slot(y)];
    std::int32_t* const refused = ring_.refused[slot(y)];
    clear(slot(y));
    std::copy(args_.before.row(y) + begin, args_.before.row(y) + end, values + place);
    if (args_.moves.empty()) return;  // the bits are zeros
    lanes_.refuse(moves_.refusals, args_.moves.dx.row(y) + begin, args_.moves.dy.row(y) + begin,
                  end - begin, refused + place);
  }

  NearRows before(int y) const {
    NearRows rows{};
    rows.moves = moves_.all;
    for (int dy = -args_.reach; dy <= args_.reach; ++dy) {
      rows.values[dy + args_.reach] = ring_.values[slot(y - dy)] + kNearPad;
      rows.refused[dy + args_.reach] = ring_.refused[slot(y - dy)] + kNearPad;
    }
    return rows;
  }

  const Args& args_;
  const DpStageLanes& lanes_;
  const Moves& moves_;
  Box box_;
  Ring ring_{};
};

}  // namespace

void run_near(const Args& args, Workers& workers) {
  if (args.score.empty()) return;
  const Moves moves = moves_of(args.reach, args.tolerance);
  const DpStageLanes& lanes = dp_stage_lanes(workers.isa());
  const Tiles rows{static_cast<std::size_t>(args.score.height), kRowTile};
  const Tiles columns{static_cast<std::size_t>(args.score.width), kColumns};
  workers.for_tiles(rows.tiles() * columns.tiles(), [&](std::size_t t) {
    const std::size_t r = t / columns.tiles(), c = t % columns.tiles();
    Tile(args, lanes, moves,
         {static_cast<int>(columns.begin(c)), static_cast<int>(rows.begin(r)),
          static_cast<int>(columns.end(c)), static_cast<int>(rows.end(r))})
        .run();
  });
}

}  // namespace glint::dp_stage

// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/core/tiles.hpp"
#include "glint/kernels/core/workers.hpp"
#include "glint/kernels/pick_cells/pick_cells.hpp"

namespace glint {

// A pick reads a window of its own and decides by sums in double: nothing to vectorise.
void PickCells::tbb(const Args& args, Workers& workers) {
  pick_cells::check(args);
  const Tiles tiles{args.cell.size(), 512};
  workers.for_tiles(tiles.tiles(), [&](std::size_t t) {
    const std::size_t first = tiles.begin(t), count = tiles.end(t) - first;
    serial({args.score, args.reach, args.cell.subspan(first, count),
            args.uniform.subspan(first, count), args.picked.subspan(first, count),
            args.picked_score.subspan(first, count), args.total.subspan(first, count)});
  });
}

}  // namespace glint

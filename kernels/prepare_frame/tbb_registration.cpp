// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "glint/kernels/core/tiles.hpp"
#include "glint/kernels/prepare_frame/lanes.hpp"
#include "glint/kernels/prepare_frame/registration.hpp"
#include "glint/kernels/prepare_frame/search.hpp"

namespace glint {
namespace {

ShiftPass make_pass(FrameView reference, FrameView moving, double dx, double dy) {
  const double ix = std::floor(dx), iy = std::floor(dy);
  return {reference.data,
          moving.data,
          reference.pitch,
          moving.pitch,
          moving.width,
          moving.height,
          static_cast<int>(ix),
          static_cast<int>(iy),
          static_cast<float>(dx - ix),
          static_cast<float>(dy - iy)};
}

/// Sums f(row) over the rows that the estimate looks at, tile by tile, in order.
template <class Sums, class F, class Add>
Sums sum_rows(int height, int first, int step, Workers& workers, const F& f, const Add& add) {
  constexpr std::size_t kMaxTiles = 64;
  const auto rows = static_cast<std::size_t>(std::max(0, (height - first + step - 1) / step));
  const Tiles tiles{rows, std::max<std::size_t>(64, rows / kMaxTiles + 1)};
  std::array<Sums, kMaxTiles> partial{};
  workers.for_tiles(tiles.tiles(), [&](std::size_t t) {
    for (std::size_t i = tiles.begin(t); i < tiles.end(t); ++i) {
      add(partial[t], f(first + static_cast<int>(i) * step));
    }
  });
  Sums total{};
  for (std::size_t t = 0; t < tiles.tiles(); ++t) add(total, partial[t]);
  return total;
}

}  // namespace

void Halve::tbb(const Args& args, Workers& workers) {
  const auto& lanes = prepare_frame_lanes(workers.isa());
  const Tiles tiles{static_cast<std::size_t>(args.half.height), kRowTile};
  workers.for_tiles(tiles.tiles(), [&](std::size_t t) {
    for (std::size_t i = tiles.begin(t); i < tiles.end(t); ++i) {
      const int y = static_cast<int>(i);
      lanes.halve(args.image.row(2 * y), args.image.row(2 * y + 1), args.half.row(y),
                  args.half.width);
    }
  });
}

void EstimateShift::tbb(const Args& args, Workers& workers) {
  const auto& lanes = prepare_frame_lanes(workers.isa());
  const auto difference = [&](FrameView reference, FrameView moving, double dx, double dy) {
    const ShiftPass pass = make_pass(reference, moving, dx, dy);
    const auto add = [](DifferenceSums& a, const DifferenceSums& b) {
      a.sum += b.sum, a.count += b.count;
    };
    const auto sums = sum_rows<DifferenceSums>(
        pass.height, 0, row_step(pass.width, pass.height), workers,
        [&](int y) { return lanes.difference(pass, y); }, add);
    return sums.count == 0 ? 0 : sums.sum / static_cast<double>(sums.count);
  };
  const auto equations = [&](FrameView reference, FrameView moving, double dx, double dy) {
    const ShiftPass pass = make_pass(reference, moving, dx, dy);
    const auto add = [](EquationSums& a, const EquationSums& b) {
      a.xx += b.xx, a.xy += b.xy, a.yy += b.yy, a.xe += b.xe, a.ye += b.ye;
    };
    const auto s = sum_rows<EquationSums>(
        pass.height - 1, 1, row_step(pass.width, pass.height), workers,
        [&](int y) { return lanes.equations(pass, y); }, add);
    return NormalEquations{s.xx, s.xy, s.yy, s.xe, s.ye};
  };
  *args.shift = search_shift(args, difference, equations);
}

void ShiftImage::tbb(const Args& args, Workers& workers) {
  const auto& lanes = prepare_frame_lanes(workers.isa());
  const ShiftPass pass = make_pass(args.image, args.image, args.dx, args.dy);
  const Tiles tiles{static_cast<std::size_t>(args.image.height), kRowTile};
  workers.for_tiles(tiles.tiles(), [&](std::size_t t) {
    for (std::size_t i = tiles.begin(t); i < tiles.end(t); ++i) {
      const int y = static_cast<int>(i);
      lanes.shift(pass, args.moved.row(y), y);
    }
  });
}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/kernels/cell_weights/cell_weights.hpp"
#include "glint/kernels/core/function_ref.hpp"
#include "glint/kernels/core/workers.hpp"

namespace glint::cell_weights {

/// The threads of one call; small problems stay on the caller's.
struct Passes {
  Workers& workers;
  bool parallel;

  void each(std::size_t count, FunctionRef<void(std::size_t)> f) const {
    if (parallel) return workers.for_tiles(count, f);
    for (std::size_t i = 0; i < count; ++i) f(i);
  }
};

/// From the places of `count` particles in space.keys, writes space.runs' order, cell and first: a
/// stable counting sort by column, then by row. Returns how many particles are in no pixel; they
/// lie at the end of space.indices. Work grows with particles and the frame's sides, not its area.
std::size_t sort_cells(std::size_t count, int width, int height, const Passes& passes,
                       CellWorkspace& space);

}  // namespace glint::cell_weights

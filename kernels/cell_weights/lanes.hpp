// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/kernels/cell_weights/cell_weights.hpp"
#include "glint/kernels/core/isa.hpp"

namespace glint {
namespace cell_weights {

/// Row and column of a pixel in one word. A particle in no pixel is in column `width`.
inline constexpr int kRowShift = 16;
inline constexpr std::uint32_t kColumnMask = 0xffff;

struct Particles {
  const float *x, *y, *predicted, *log_ratio;
  std::uint32_t* place;
  float* weighted;
};

}  // namespace cell_weights

struct CellWeightsLanes {
  /// Finds place and w l of the particles [begin, end).
  void (*weigh)(const cell_weights::Particles& particles, int width, int height, std::size_t begin,
                std::size_t end);
};

GLINT_DECLARE_LANES(CellWeightsLanes, cell_weights_lanes)

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>

#include "glint/kernels/core/isa.hpp"
#include "glint/kernels/core/point_spread.hpp"
#include "glint/kernels/pixel_likelihood/pixel_likelihood.hpp"

namespace glint {

/// One frame's work in float, as all its tiles see it. The map is gain A + energy terms, with A the
/// correlation of pixel - offset with weights relative to the centre's.
template <class T>
struct PixelPass {
  const T* frame;
  std::ptrdiff_t pitch;
  int width, height;
  float* map;  ///< null: hits only
  std::ptrdiff_t map_pitch;
  bool stream;  ///< store past the caches: the map's rows are on 64-byte boundaries
  float offset, gain, threshold;
  float relative[kMaxHalfWidth + 1];  ///< weight k pixels from the centre over the centre's
  float squared[kMaxHalfWidth + 1];   ///< weight k pixels from the centre, squared
  float energy_gain;                  ///< -I^2 / 2
};

/// Does rows [y0, y1): writes the map, puts up to `capacity` hits at `hits`, row by row, and
/// returns how many there are.
template <class T>
using PixelRows = std::size_t (*)(const PixelPass<T>&, int y0, int y1, Hit* hits,
                                  std::size_t capacity);

struct PixelLikelihoodLanes {
  PixelRows<float> float_rows[kMaxHalfWidth + 1];  ///< by half width
  PixelRows<std::uint16_t> uint16_rows[kMaxHalfWidth + 1];
};
GLINT_DECLARE_LANES(PixelLikelihoodLanes, pixel_likelihood_lanes)

}  // namespace glint

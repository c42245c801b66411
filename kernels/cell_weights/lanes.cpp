// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/cell_weights/lanes.hpp"

#include "glint/kernels/cell_weights/bound.hpp"
#include "glint/kernels/core/math.hpp"

namespace glint::GLINT_LANES {
namespace {

using cell_weights::kRowShift;

void weigh(const cell_weights::Particles& particles, int width, int height, std::size_t begin,
           std::size_t end) {
  const float* __restrict x = particles.x;
  const float* __restrict y = particles.y;
  const float* __restrict predicted = particles.predicted;
  const float* __restrict log_ratio = particles.log_ratio;
  std::uint32_t* __restrict place = particles.place;
  float* __restrict weighted = particles.weighted;
  const auto right = static_cast<float>(width), bottom = static_cast<float>(height);
  const auto outside = static_cast<std::uint32_t>(width);
  for (std::size_t i = begin; i < end; ++i) {
    const float column = x[i] + 0.5f, row = y[i] + 0.5f;  // the pixel is the floor
    const bool inside = (column >= 0.0f) & (column < right) & (row >= 0.0f) & (row < bottom);
    const auto column_index = static_cast<std::int32_t>(inside ? column : 0.0f);
    const auto row_index = static_cast<std::int32_t>(inside ? row : 0.0f);
    const std::uint32_t packed = static_cast<std::uint32_t>(row_index) << kRowShift |
                                 static_cast<std::uint32_t>(column_index);
    place[i] = inside ? packed : outside;
    const float ratio = log_ratio[i];
    const float product = predicted[i] * math::exp(bounded_log_ratio(ratio));
    weighted[i] = ratio == ratio ? product : 0.0f;
  }
}

}  // namespace

extern const CellWeightsLanes cell_weights_lanes;
const CellWeightsLanes cell_weights_lanes = {&weigh};

}  // namespace glint::GLINT_LANES

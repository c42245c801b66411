// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/all.hpp"

#include <array>

#include "glint/kernels/add_noise/add_noise.hpp"
#include "glint/kernels/birth_scores/birth_scores.hpp"
#include "glint/kernels/cell_integrals/cell_integrals.hpp"
#include "glint/kernels/cell_weights/cell_weights.hpp"
#include "glint/kernels/dp_stage/dp_stage.hpp"
#include "glint/kernels/find_points/find_points.hpp"
#include "glint/kernels/particle_likelihood/particle_likelihood.hpp"
#include "glint/kernels/pick_cells/pick_cells.hpp"
#include "glint/kernels/pixel_likelihood/pixel_likelihood.hpp"
#include "glint/kernels/prepare_frame/prepare_frame.hpp"
#include "glint/kernels/propagate/propagate.hpp"
#include "glint/kernels/resample/resample.hpp"

namespace glint {
namespace {

template <Kernel K>
KernelEntry entry() {
  return {K::name, EglKernel<K>};
}

}  // namespace

std::span<const KernelEntry> all_kernels() {
  static const std::array kAll{
      KernelEntry{"prepare_frame", true},
      entry<PixelLikelihood>(),
      entry<ParticleLikelihood>(),
      entry<Propagate>(),
      entry<Resample>(),
      entry<CellWeights>(),
      entry<CellIntegrals>(),
      entry<FindPoints>(),
      entry<BirthScores>(),
      entry<PickCells>(),
      entry<DpStage>(),
      entry<AddNoise>(),
  };
  return kAll;
}

}  // namespace glint

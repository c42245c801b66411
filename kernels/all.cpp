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
#include "glint/kernels/pixel_likelihood/pixel_likelihood.hpp"
#include "glint/kernels/prepare_frame/prepare_frame.hpp"
#include "glint/kernels/propagate/propagate.hpp"
#include "glint/kernels/resample/resample.hpp"

namespace glint {

std::span<const KernelEntry> all_kernels() {
  static const std::array kAll{
      KernelEntry{"prepare_frame", &prepare_frame_trials},
      KernelEntry{PixelLikelihood::name, &PixelLikelihood::trials},
      KernelEntry{ParticleLikelihood::name, &ParticleLikelihood::trials},
      KernelEntry{Propagate::name, &Propagate::trials},
      KernelEntry{Resample::name, &Resample::trials},
      KernelEntry{CellWeights::name, &CellWeights::trials},
      KernelEntry{CellIntegrals::name, &CellIntegrals::trials},
      KernelEntry{FindPoints::name, &FindPoints::trials},
      KernelEntry{BirthScores::name, &BirthScores::trials},
      KernelEntry{DpStage::name, &DpStage::trials},
      KernelEntry{AddNoise::name, &AddNoise::trials},
  };
  return kAll;
}

}  // namespace glint

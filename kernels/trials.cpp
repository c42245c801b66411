// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/trials.hpp"

#include <stdexcept>
#include <string>

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

template <class... Kernels>
std::vector<std::unique_ptr<Trial>> trials_among(std::string_view name) {
  std::vector<std::unique_ptr<Trial>> trials;
  if (name == "prepare_frame") trials = prepare_frame_trials();
  ((name == Kernels::name ? void(trials = Kernels::trials()) : void()), ...);
  return trials;
}

}  // namespace

std::vector<std::unique_ptr<Trial>> trials_of(const KernelEntry& kernel) {
  auto trials = trials_among<PixelLikelihood, ParticleLikelihood, Propagate, Resample, CellWeights,
                             CellIntegrals, FindPoints, BirthScores, PickCells, DpStage, AddNoise>(
      kernel.name);
  if (trials.empty()) throw std::logic_error("no trials of kernel " + std::string(kernel.name));
  return trials;
}

}  // namespace glint

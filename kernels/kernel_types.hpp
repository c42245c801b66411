// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/kernels/add_noise/add_noise.hpp"
#include "glint/kernels/birth_scores/birth_scores.hpp"
#include "glint/kernels/cell_integrals/cell_integrals.hpp"
#include "glint/kernels/cell_weights/cell_weights.hpp"
#include "glint/kernels/dp_stage/dp_stage.hpp"
#include "glint/kernels/find_points/find_points.hpp"
#include "glint/kernels/particle_likelihood/particle_likelihood.hpp"
#include "glint/kernels/pick_cells/pick_cells.hpp"
#include "glint/kernels/pixel_likelihood/pixel_likelihood.hpp"
#include "glint/kernels/propagate/propagate.hpp"
#include "glint/kernels/resample/resample.hpp"

namespace glint {

template <class... Kernels>
struct KernelTypes {};

/// The one list of kernels. Those of prepare_frame come ahead of it, as one.
using AllKernels =
    KernelTypes<PixelLikelihood, ParticleLikelihood, Propagate, Resample, CellWeights,
                CellIntegrals, FindPoints, BirthScores, PickCells, DpStage, AddNoise>;

}  // namespace glint

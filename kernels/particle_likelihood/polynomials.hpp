// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/kernels/particle_likelihood/lanes.hpp"

namespace glint {

/// Fits the weights for offsets of up to half a pixel, to 1e-6 of the target's intensity. No
/// allocation; a few microseconds.
WeightPolynomials fit_weights(const PointSpread& spread);
/// The same with a given number of terms, 2 to kMaxTerms.
WeightPolynomials fit_weights(const PointSpread& spread, int terms);

}  // namespace glint

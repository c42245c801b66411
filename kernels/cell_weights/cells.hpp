// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/kernels/cell_weights/cell_weights.hpp"

namespace glint::cell_weights {

/// Throws as CellWeights says.
void check(const CellWeights::Args& args);

/// The same arithmetic on the same values for all devices: box sums of the runs [begin, end).
void box_sums(const CellRuns& runs, int width, int half_width, const float* values, float* sums,
              std::size_t begin, std::size_t end);

}  // namespace glint::cell_weights

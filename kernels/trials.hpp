// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <vector>

#include "glint/kernels/all.hpp"
#include "glint/kernels/core/trial.hpp"

namespace glint {

/// A kernel's trials at every tested size: empty, one, tile-1, tile, tile+1, odd widths, borders,
/// modes. Throws std::logic_error if the kernel has none.
std::vector<std::unique_ptr<Trial>> trials_of(const KernelEntry& kernel);

}  // namespace glint

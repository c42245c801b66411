// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>

#include "glint/kernels/core/trial.hpp"

namespace glint {

/// The one list of kernels: parity tests, `glint parity` and benchmarks run over it.
std::span<const KernelEntry> all_kernels();

}  // namespace glint

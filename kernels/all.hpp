// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <string_view>

namespace glint {

/// A kernel as parity tests and benchmarks see it.
struct KernelEntry {
  std::string_view name;
  bool on_egl = false;  ///< else an egl device runs it on tbb
};

/// All kernels (kernel_types.hpp): parity tests, `glint parity` and benchmarks run over them.
std::span<const KernelEntry> all_kernels();

}  // namespace glint

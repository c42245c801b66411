// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/all.hpp"

#include <array>

#include "glint/kernels/core/device.hpp"
#include "glint/kernels/kernel_types.hpp"

namespace glint {
namespace {

template <class... Kernels>
constexpr auto entries(KernelTypes<Kernels...>) {
  return std::array{KernelEntry{"prepare_frame", true},
                    KernelEntry{Kernels::name, EglKernel<Kernels>}...};
}

}  // namespace

std::span<const KernelEntry> all_kernels() {
  static constexpr auto kAll = entries(AllKernels{});
  return kAll;
}

}  // namespace glint

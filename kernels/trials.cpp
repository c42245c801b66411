// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/trials.hpp"

#include <stdexcept>
#include <string>

#include "glint/kernels/kernel_types.hpp"
#include "glint/kernels/prepare_frame/prepare_frame.hpp"

namespace glint {
namespace {

template <class... Kernels>
std::vector<std::unique_ptr<Trial>> trials_among(KernelTypes<Kernels...>, std::string_view name) {
  std::vector<std::unique_ptr<Trial>> trials;
  if (name == "prepare_frame") trials = prepare_frame_trials();
  ((name == Kernels::name ? void(trials = Kernels::trials()) : void()), ...);
  return trials;
}

}  // namespace

std::vector<std::unique_ptr<Trial>> trials_of(const KernelEntry& kernel) {
  auto trials = trials_among(AllKernels{}, kernel.name);
  if (trials.empty()) throw std::logic_error("no trials of kernel " + std::string(kernel.name));
  return trials;
}

}  // namespace glint

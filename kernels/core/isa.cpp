// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/core/isa.hpp"

#include <array>

namespace glint {

std::string_view name(Isa isa) {
  constexpr std::array<std::string_view, 3> kNames{"plain", "x86-64-v3", "x86-64-v4"};
  return kNames[static_cast<std::size_t>(isa)];
}

Isa best_isa() {
#ifdef GLINT_X86_LANES
  static const Isa kBest = [] {
    __builtin_cpu_init();
    const bool v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                    __builtin_cpu_supports("bmi2");
    const bool v4 = v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                    __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
                    __builtin_cpu_supports("avx512vl");
    return v4 ? Isa::v4 : v3 ? Isa::v3 : Isa::plain;
  }();
  return kBest;
#else
  return Isa::plain;
#endif
}

std::span<const Isa> runnable_isas() {
  static constexpr std::array<Isa, 3> kAll{Isa::plain, Isa::v3, Isa::v4};
  return std::span(kAll).first(static_cast<std::size_t>(best_isa()) + 1);
}

}  // namespace glint

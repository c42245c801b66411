// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <string_view>

namespace glint {

/// Instruction sets that the lanes of a kernel are built for. All give the same bits.
enum class Isa { plain, v3, v4 };

std::string_view name(Isa isa);
/// The widest instruction set that this build has and this processor runs.
Isa best_isa();
/// Every instruction set that this build has and this processor runs, narrowest first.
std::span<const Isa> runnable_isas();

/// Picks the build of a kernel's lanes for `isa`.
template <class Lanes>
const Lanes& select(Isa isa, const Lanes& plain, const Lanes& v3, const Lanes& v4) {
  return isa == Isa::v4 ? v4 : isa == Isa::v3 ? v3 : plain;
}

}  // namespace glint

// A kernel's lanes.cpp defines one function table, `const KLanes k_lanes = {...};`, in its
// namespace; this declares the builds, and `k_lanes(isa)` that picks one.
#ifdef GLINT_X86_LANES
#define GLINT_DECLARE_LANES(Type, table)                                      \
  namespace lanes_plain {                                                     \
  extern const Type table;                                                    \
  }                                                                           \
  namespace lanes_v3 {                                                        \
  extern const Type table;                                                    \
  }                                                                           \
  namespace lanes_v4 {                                                        \
  extern const Type table;                                                    \
  }                                                                           \
  inline const Type& table(Isa isa) {                                         \
    return select(isa, lanes_plain::table, lanes_v3::table, lanes_v4::table); \
  }
#else
#define GLINT_DECLARE_LANES(Type, table) \
  namespace lanes_plain {                \
  extern const Type table;               \
  }                                      \
  inline const Type& table(Isa) { return lanes_plain::table; }
#endif

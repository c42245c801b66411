// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string_view>

namespace glint {

/// Hash of nothing, that FNV-1a begins with (Fowler, Noll and Vo, 64 bits).
inline constexpr std::uint64_t kFnvBasis = 0xcbf29ce484222325U;

/// The hash after one more byte, or after a wider word taken as one.
constexpr std::uint64_t fnv1a_step(std::uint64_t hash, std::uint64_t word) {
  return (hash ^ word) * 0x100000001b3U;
}

/// FNV-1a of bytes; `hash` is that of what stands before them.
constexpr std::uint64_t fnv1a(std::string_view bytes, std::uint64_t hash = kFnvBasis) {
  for (const char c : bytes) hash = fnv1a_step(hash, static_cast<unsigned char>(c));
  return hash;
}

}  // namespace glint

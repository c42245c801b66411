// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <vector>

namespace glint {

/// Memory on 64-byte boundaries; large blocks on huge pages where the system has them, because
/// kernels that walk a dozen rows at once otherwise wait for address translation (2x to 3x for a
/// map of 64 MB). Throws std::bad_alloc.
void* allocate_aligned(std::size_t bytes);
void free_aligned(void* block, std::size_t bytes);

/// Allocates on 64-byte boundaries: one cache line, one AVX-512 register.
template <class T>
struct AlignedAllocator {
  using value_type = T;
  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(allocate_aligned(n * sizeof(T))); }
  void deallocate(T* p, std::size_t n) { free_aligned(p, n * sizeof(T)); }
  bool operator==(const AlignedAllocator&) const = default;
};

template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;

}  // namespace glint

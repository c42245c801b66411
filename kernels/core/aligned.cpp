// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/core/aligned.hpp"

#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace glint {
namespace {

constexpr std::size_t kHugePage = std::size_t{2} << 20;
/// Below this the rounding up to whole pages would waste more than translation costs.
constexpr std::size_t kLarge = 4 * kHugePage;

std::align_val_t alignment(std::size_t bytes) {
  return std::align_val_t{bytes >= kLarge ? kHugePage : 64};
}

}  // namespace

void* allocate_aligned(std::size_t bytes) {
  void* block = ::operator new(bytes, alignment(bytes));
#ifdef __linux__
  // Advice only: without huge pages the memory is as good as any.
  if (bytes >= kLarge) madvise(block, bytes / kHugePage * kHugePage, MADV_HUGEPAGE);
#endif
  return block;
}

void free_aligned(void* block, std::size_t bytes) { ::operator delete(block, alignment(bytes)); }

}  // namespace glint

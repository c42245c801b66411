// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

// Counts every operator new of an executable: to be included by one of its files alone.
namespace glint::test {

inline std::atomic<std::size_t> allocations{0};
inline std::atomic<std::size_t> live_bytes{0};

inline void* counted(void* block) {
  if (block == nullptr) throw std::bad_alloc();
  allocations.fetch_add(1, std::memory_order_relaxed);
  live_bytes.fetch_add(malloc_usable_size(block), std::memory_order_relaxed);
  return block;
}

inline void release(void* block) {
  live_bytes.fetch_sub(malloc_usable_size(block), std::memory_order_relaxed);
  std::free(block);
}

}  // namespace glint::test

[[gnu::noinline]] void* operator new(std::size_t size) {
  return glint::test::counted(std::malloc(std::max<std::size_t>(size, 1)));
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto to = static_cast<std::size_t>(alignment);
  return glint::test::counted(std::aligned_alloc(to, (size + to - 1) / to * to));
}
[[gnu::noinline]] void operator delete(void* block) noexcept { glint::test::release(block); }
[[gnu::noinline]] void operator delete(void* block, std::size_t) noexcept {
  glint::test::release(block);
}
[[gnu::noinline]] void operator delete(void* block, std::align_val_t) noexcept {
  glint::test::release(block);
}
[[gnu::noinline]] void operator delete(void* block, std::size_t, std::align_val_t) noexcept {
  glint::test::release(block);
}

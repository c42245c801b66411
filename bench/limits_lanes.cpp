// SPDX-License-Identifier: Apache-2.0
#include "glint/bench/limits_lanes.hpp"

#ifdef __SSE2__
#include <immintrin.h>
#endif

#include "glint/kernels/core/inline.hpp"

namespace glint::GLINT_LANES {
namespace {

typedef float Vector __attribute__((vector_size(64)));
typedef std::uint16_t Words __attribute__((vector_size(32)));

GLINT_INLINE void keep() { asm volatile("" ::: "memory"); }

// Past the caches, where the instruction set can.
GLINT_INLINE void stream(float* to, const Vector& v) {
#if defined(__AVX512F__)
  _mm512_stream_ps(to, reinterpret_cast<const __m512&>(v));
#elif defined(__AVX__)
  for (int i = 0; i < 2; ++i) _mm256_stream_ps(to + 8 * i, reinterpret_cast<const __m256*>(&v)[i]);
#elif defined(__SSE2__)
  for (int i = 0; i < 4; ++i) _mm_stream_ps(to + 4 * i, reinterpret_cast<const __m128*>(&v)[i]);
#else
  *reinterpret_cast<Vector*>(to) = v;
#endif
}
GLINT_INLINE void end_stream() {
#ifdef __SSE2__
  _mm_sfence();
#endif
}
GLINT_INLINE const Vector& load(const float* from) {
  return *reinterpret_cast<const Vector*>(from);
}

void stream_copy(const float* from, float* to, int n) {
  for (int i = 0; i < n; i += 16) stream(to + i, load(from + i));
  end_stream();
}

void stream_widen(const std::uint16_t* from, float* to, int n) {
  for (int i = 0; i < n; i += 16) {
    const Words words = *reinterpret_cast<const Words*>(from + i);
    stream(to + i, __builtin_convertvector(words, Vector));
  }
  end_stream();
}

void read(const float* from, int n) {
  Vector sum[4] = {};
  for (int i = 0; i < n; i += 64) {
    for (int k = 0; k < 4; ++k) sum[k] += load(from + i + 16 * k);
  }
  const Vector total = sum[0] + sum[1] + sum[2] + sum[3];
  asm volatile("" ::"m"(total));
}

void scale_in_place(float* values, int n) {
  for (int i = 0; i < n; i += 16) *reinterpret_cast<Vector*>(values + i) *= 1.0000001f;
  keep();
}

void combine(const float* a, const float* b, const float* c, float* to, int n) {
  for (int i = 0; i < n; i += 16) {
    *reinterpret_cast<Vector*>(to + i) = load(a + i) * load(b + i) + load(c + i);
  }
  keep();
}

}  // namespace

extern const LimitLanes limit_lanes;
const LimitLanes limit_lanes{stream_copy, stream_widen, read, scale_in_place, combine};

}  // namespace glint::GLINT_LANES

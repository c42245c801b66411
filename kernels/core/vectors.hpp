// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <utility>

#include "glint/kernels/core/inline.hpp"

#ifdef __AVX2__
#include <immintrin.h>
#endif

/// Vectors of a lanes.cpp, for loops that the compiler does not find by itself. Arithmetic comes
/// from the compiler's vector types; only what those lack (fma, streaming stores, lane masks) is
/// written per instruction set. Include in lanes.cpp only.
namespace glint::GLINT_LANES {

#ifdef __AVX512F__
inline constexpr int kLanes = 16;
#else
inline constexpr int kLanes = 8;
#endif

template <int N>
struct Vector {
  // Not `using`: g++ drops a dependent attribute there.
  typedef float F __attribute__((vector_size(4 * N)));            // NOLINT(modernize-use-using)
  typedef std::int32_t I __attribute__((vector_size(4 * N)));     // NOLINT(modernize-use-using)
  typedef std::uint16_t U16 __attribute__((vector_size(2 * N)));  // NOLINT(modernize-use-using)
};
template <int N>
using Floats = typename Vector<N>::F;
template <int N>
using Ints = typename Vector<N>::I;

template <class V, class X, int... K>
GLINT_INLINE V broadcast_to(X x, std::integer_sequence<int, K...>) {
  return V{(static_cast<void>(K), x)...};
}
/// `x` in every lane. Not x + V{}: that is an addition, for the sake of -0.
template <class V, class X>
GLINT_INLINE V broadcast(X x) {
  return broadcast_to<V>(x, std::make_integer_sequence<int, sizeof(V) / 4>{});
}

template <int N>
GLINT_INLINE Floats<N> load(const float* p) {
  Floats<N> v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}
template <int N>
GLINT_INLINE Floats<N> to_floats(typename Vector<N>::U16 v) {
  return __builtin_convertvector(__builtin_convertvector(v, Ints<N>), Floats<N>);
}
template <int N>
GLINT_INLINE Floats<N> load(const std::uint16_t* p) {
  typename Vector<N>::U16 v;
  __builtin_memcpy(&v, p, sizeof v);
  return to_floats<N>(v);
}
template <int N>
GLINT_INLINE Ints<N> load(const std::int32_t* p) {
  Ints<N> v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}
template <class T, class V>
GLINT_INLINE void store(T* p, V v) {
  __builtin_memcpy(p, &v, sizeof v);
}

/// First, first + 1, ...
template <int N>
GLINT_INLINE Ints<N> count_from(int first) {
  Ints<N> v;
  for (int i = 0; i < N; ++i) v[i] = i;
  return v + first;
}

/// The first `n` elements, then zeros; reads nothing beyond them.
template <int N, class T>
GLINT_INLINE Floats<N> load_first(const T* p, int n) {
#ifdef __AVX512BW__
  const auto bits = static_cast<__mmask16>(_bzhi_u32(0xffff, static_cast<unsigned>(n)));
  if constexpr (N == 16 && sizeof(T) == 4) return (Floats<N>)_mm512_maskz_loadu_ps(bits, p);
  if constexpr (N == 16 && sizeof(T) == 2) {
    return to_floats<N>((typename Vector<N>::U16)_mm256_maskz_loadu_epi16(bits, p));
  }
#endif
#ifdef __AVX2__
  if constexpr (N == 8 && sizeof(T) == 4) {
    const Ints<N> first = count_from<N>(0) < n;
    return (Floats<N>)_mm256_maskload_ps(p, (__m256i)first);
  }
#endif
  T some[N] = {};
  for (int i = 0; i < n; ++i) some[i] = p[i];
  return load<N>(some);
}
/// Stores the first `n` elements.
template <class V>
GLINT_INLINE void store_first(float* p, V v, int n) {
#ifdef __AVX512F__
  if constexpr (sizeof(V) == 64) {
    const auto bits = static_cast<__mmask16>(_bzhi_u32(0xffff, static_cast<unsigned>(n)));
    return _mm512_mask_storeu_ps(p, bits, (__m512)v);
  }
#endif
  for (int i = 0; i < n; ++i) p[i] = v[i];
}
/// `a` where the lane of the comparison is true, zero elsewhere.
template <class V, class M>
GLINT_INLINE V where(M lanes, V a) {
  return (V)((M)a & lanes);
}
/// `a` where the lane of the comparison is true, `b` elsewhere.
template <class V, class M>
GLINT_INLINE V where(M lanes, V a, V b) {
  return (V)(((M)a & lanes) | ((M)b & ~lanes));
}

/// a < b ? a : b, lane by lane.
template <class V>
GLINT_INLINE V lesser(V a, V b) {
#ifdef __AVX512F__
  if constexpr (sizeof(V) == 64) return (V)_mm512_maskz_min_ps(0xffff, (__m512)a, (__m512)b);
#endif
#ifdef __AVX2__
  if constexpr (sizeof(V) == 32) return (V)_mm256_min_ps((__m256)a, (__m256)b);
#endif
  return where(a < b, a, b);
}
/// a < b ? b : a, lane by lane.
template <class V>
GLINT_INLINE V greater(V a, V b) {
#ifdef __AVX512F__
  if constexpr (sizeof(V) == 64) return (V)_mm512_maskz_max_ps(0xffff, (__m512)b, (__m512)a);
#endif
#ifdef __AVX2__
  if constexpr (sizeof(V) == 32) return (V)_mm256_max_ps((__m256)b, (__m256)a);
#endif
  return where(a < b, b, a);
}

/// Lane by lane; out of line where each lane costs a call anyway.
#if defined(__FMA__) || defined(__aarch64__)
template <class V>
GLINT_INLINE V fma_each(V a, V b, V c) {
#else
template <class V>
[[gnu::noinline]] V fma_each(V a, V b, V c) {
#endif
  for (std::size_t i = 0; i < sizeof(V) / 4; ++i) c[i] = __builtin_fmaf(a[i], b[i], c[i]);
  return c;
}

template <class V>
GLINT_INLINE V fma(V a, V b, V c) {
#ifdef __AVX512F__
  if constexpr (sizeof(V) == 64) return (V)_mm512_fmadd_ps((__m512)a, (__m512)b, (__m512)c);
#endif
#ifdef __AVX2__
  if constexpr (sizeof(V) == 32) return (V)_mm256_fmadd_ps((__m256)a, (__m256)b, (__m256)c);
#endif
  return fma_each(a, b, c);
}

/// Stores past the caches where the instruction set can; `p` is aligned to the vector.
template <class V>
GLINT_INLINE void stream(float* p, V v) {
#ifdef __AVX512F__
  if constexpr (sizeof(V) == 64) return _mm512_stream_ps(p, (__m512)v);
#endif
#ifdef __AVX2__
  if constexpr (sizeof(V) == 32) return _mm256_stream_ps(p, (__m256)v);
#endif
  store(p, v);
}
/// Orders streamed stores before what follows.
GLINT_INLINE void fence() {
#ifdef __AVX2__
  _mm_sfence();
#endif
}

/// Bit i: a[i] > b[i].
template <class V>
GLINT_INLINE unsigned above(V a, V b) {
#ifdef __AVX512F__
  if constexpr (sizeof(V) == 64) return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_GT_OQ);
#endif
#ifdef __AVX2__
  if constexpr (sizeof(V) == 32) {
    return static_cast<unsigned>(
        _mm256_movemask_ps(_mm256_cmp_ps((__m256)a, (__m256)b, _CMP_GT_OQ)));
  }
#endif
  unsigned bits = 0;
  for (std::size_t i = 0; i < sizeof(V) / 4; ++i) bits |= static_cast<unsigned>(a[i] > b[i]) << i;
  return bits;
}

template <int First, class V, int... K>
GLINT_INLINE V window_of(V a, V b, std::integer_sequence<int, K...>) {
  return __builtin_shufflevector(a, b, (First + K)...);
}
/// Elements First, First + 1, ... of a and b in a row.
template <int First, class V>
GLINT_INLINE V window(V a, V b) {
  constexpr int kSize = sizeof(V) / 4;
  if constexpr (First == kSize) return b;
#ifdef __AVX512F__  // g++ makes two instructions of the shuffle
  if constexpr (sizeof(V) == 64) {
    return (V)_mm512_maskz_alignr_epi32(0xffff, (__m512i)b, (__m512i)a, First);
  }
#endif
  return window_of<First>(a, b, std::make_integer_sequence<int, kSize>{});
}

}  // namespace glint::GLINT_LANES

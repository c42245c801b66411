// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/kernels/pixel_likelihood/sweep.hpp"

namespace glint::GLINT_LANES::pixel_likelihood {

/// Hits that a sweep may have before its rows are swept one by one.
inline constexpr std::size_t kHitBuffer = 1024;

/// Takes the hits of rows [y + first, y + last): counts all, keeps those that fit.
struct HitSink {
  Hit* hits;
  std::size_t capacity, count;
  int y, first, last;
};

GLINT_INLINE void push(HitSink& sink, int x, int y, float value) {
  if (sink.count < sink.capacity) {
    Hit& hit = sink.hits[sink.count];
    hit.x = x, hit.y = y, hit.value = value;
  }
  ++sink.count;
}

static_assert(kRows * kLanes <= 64);

GLINT_INLINE unsigned first_lanes(int n) { return (2u << (n - 1)) - 1; }
GLINT_INLINE std::uint64_t every_row(unsigned lanes) {
  std::uint64_t all = 0;
  for (int k = 0; k < kRows; ++k) all |= std::uint64_t{lanes} << (k * kLanes);
  return all;
}

/// Takes the values at columns x, x + 1, ... whose bits are set, row by row.
[[gnu::noinline]] inline void collect(HitSink& sink, const V* value, std::uint64_t bits, int x) {
  const int unwanted = 64 - sink.last * kLanes;
  bits = bits >> (sink.first * kLanes) << (sink.first * kLanes);
  bits = bits << unwanted >> unwanted;
  for (; bits != 0; bits &= bits - 1) {
    const int i = __builtin_ctzll(bits);
    push(sink, x + i % kLanes, sink.y + i / kLanes, value[i / kLanes][i % kLanes]);
  }
}

/// Appends the kept hits of row y.
GLINT_INLINE void move_row(const HitSink& from, int y, HitSink& to) {
  for (std::size_t i = 0; i < from.count; ++i) {
    if (from.hits[i].y == y) push(to, from.hits[i].x, y, from.hits[i].value);
  }
}

}  // namespace glint::GLINT_LANES::pixel_likelihood

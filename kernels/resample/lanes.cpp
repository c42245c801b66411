// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/resample/lanes.hpp"

#include "glint/kernels/core/math.hpp"

namespace glint::GLINT_LANES {
namespace {

using namespace resample;

constexpr int kPart = 512;  // particles whose sums stay in the first cache

float largest(const float* weights, std::size_t count) {
  std::int32_t bits = 0;  // of floats >= 0: ordered as they are
  for (std::size_t i = 0; i < count; ++i) {
    const std::int32_t b = math::bits(valid(weights[i]));
    bits = b > bits ? b : bits;
  }
  return math::from_bits(bits);
}

std::int64_t total(const float* weights, std::size_t count, Scale scale) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += whole(weights[i], scale);
  return sum;
}

Sums split_totals(const float* weights, std::size_t count, const Rule& rule) {
  const Splitter splitter = rule.splitter;
  const Scale scale = rule.scale;
  std::int64_t copies = 0, mass = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Split s = split(whole(weights[i], scale), splitter);
    copies += s.copies;
    mass += s.remainder;
  }
  return {copies, mass};
}

/// Sum < 2^52 as double, in integer instructions that every instruction set has.
GLINT_INLINE double as_double(std::int64_t sum) {
  return __builtin_bit_cast(double, sum | 0x4330000000000000) - 0x1p52;
}

/// ends[i] = offspring of all particles up to the i-th of the part, counted from the unit's first
/// and held inside the unit.
struct Part {
  alignas(64) std::int32_t mass[kPart], copies[kPart], ends[kPart];
  alignas(64) std::int64_t sums[kPart];
};

/// Whole numbers and copies of each particle, then their sums up to it.
template <bool kSplits>
GLINT_INLINE void sum_up(const Rule& rule, const float* weights, int count, Sums& sums,
                         Part& part) {
  const Scale scale = rule.scale;
  if constexpr (kSplits) {
    const Splitter splitter = rule.splitter;
    for (int i = 0; i < count; ++i) {
      const Split s = split(whole(weights[i], scale), splitter);
      part.copies[i] = s.copies;
      part.mass[i] = s.remainder;
    }
    auto copies = static_cast<std::int32_t>(sums.copies);
    for (int i = 0; i < count; ++i) part.copies[i] = copies += part.copies[i];
    sums.copies = copies;
  } else {
    for (int i = 0; i < count; ++i) part.mass[i] = whole(weights[i], scale);
  }
  std::int64_t mass = sums.mass;
  for (int i = 0; i < count; ++i) part.sums[i] = mass += part.mass[i];
  sums.mass = mass;
}

template <bool kSplits>
GLINT_INLINE void find_ends(const Points points, const Unit& unit, int count, Part& part) {
  const std::int32_t begin = unit.begin, length = unit.end - unit.begin;
  for (int i = 0; i < count; ++i) {
    std::int32_t end = below(as_double(part.sums[i]), points) - begin;
    if constexpr (kSplits) end += part.copies[i];
    end = end < 0 ? 0 : end;
    part.ends[i] = end > length ? length : end;
  }
}

/// Writes every particle of the part where its offspring start, wanted or not: the next particle
/// overwrites one that has none. No branch to mispredict.
GLINT_INLINE std::int32_t mark_starts(const Part& part, int count, std::uint32_t first,
                                      std::int32_t start, std::uint32_t* ancestors) {
  for (int i = 0; i < count; ++i) {
    ancestors[start] = first + static_cast<std::uint32_t>(i);
    start = part.ends[i];
  }
  return start;
}

/// Particles ascend, so the largest mark so far is whose offspring this is.
GLINT_INLINE void fill_gaps(std::uint32_t* ancestors, std::int32_t length) {
  std::uint32_t particle = 0;
  for (std::int32_t j = 0; j < length; ++j) {
    particle = ancestors[j] > particle ? ancestors[j] : particle;
    ancestors[j] = particle;
  }
}

/// Four bytes of any type: arrays of floats and of integers move alike.
using Word [[gnu::may_alias]] = std::uint32_t;

GLINT_INLINE void gather(const Word* __restrict source, const std::uint32_t* __restrict ancestors,
                         std::int32_t count, Word* __restrict destination) {
  for (std::int32_t j = 0; j < count; ++j) destination[j] = source[ancestors[j]];
}

template <bool kSplits>
void draw(const Rule& rule, const Unit& unit) {
  alignas(64) std::uint32_t ancestors[kUnit + 1];  // the last one: starts behind the unit
  const std::int32_t length = unit.end - unit.begin;
  __builtin_memset(ancestors, 0, (static_cast<std::size_t>(length) + 1) * sizeof(std::uint32_t));
  Part part;
  Sums sums = unit.before;
  std::int32_t start = 0;
  for (std::size_t i = 0; i < unit.count; i += kPart) {
    const std::size_t left = unit.count - i;
    const int count = left < kPart ? static_cast<int>(left) : kPart;
    sum_up<kSplits>(rule, unit.weights + i, count, sums, part);
    find_ends<kSplits>(rule.points, unit, count, part);
    start = mark_starts(part, count, static_cast<std::uint32_t>(unit.first + i), start, ancestors);
  }
  fill_gaps(ancestors, length);
  __builtin_memcpy(unit.ancestors + unit.begin, ancestors,
                   static_cast<std::size_t>(length) * sizeof(std::uint32_t));
  for (std::size_t a = 0; a < unit.arrays; ++a) {
    gather(static_cast<const Word*>(unit.moved[a].source), ancestors, length,
           static_cast<Word*>(unit.moved[a].destination) + unit.begin);
  }
}

void draw(const Rule& rule, const Unit& unit) {
  rule.splits ? draw<true>(rule, unit) : draw<false>(rule, unit);
}

}  // namespace

extern const ResampleLanes resample_lanes;
const ResampleLanes resample_lanes = {&largest, &total, &split_totals, &draw};

}  // namespace glint::GLINT_LANES

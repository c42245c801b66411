// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>

#include "glint/kernels/core/inline.hpp"

/// The arithmetic of resampling: every device computes offspring by these formulas and no others.
/// Whole numbers stay below 2^53, so that they are exact in double.
namespace glint::resample {

/// A weight is trunc(weight factor + offset) parts of the whole.
struct Scale {
  double factor = 0, offset = 1;
};

/// Weights that nobody can mean count 0; infinity counts as the largest float.
GLINT_INLINE float valid(float weight) {
  constexpr float kLargest = 3.40282347e+38f;
  const float bounded = weight < kLargest ? weight : kLargest;
  return weight > 0.0f ? bounded : 0.0f;
}

GLINT_INLINE std::int32_t whole(float weight, Scale scale) {
  return static_cast<std::int32_t>(static_cast<double>(valid(weight)) * scale.factor +
                                   scale.offset);
}

/// Evenly spaced points: `rate` of them a unit of mass, the first one `u` into its interval.
struct Points {
  double rate = 0, lead = 0;  ///< lead = 1 - u
};

/// How many points lie below `mass`, a sum of whole numbers.
GLINT_INLINE std::int32_t below(double mass, Points points) {
  return static_cast<std::int32_t>(mass * points.rate + points.lead);
}

/// What residual resampling gives a particle: copies for sure, and mass that draws for the rest.
struct Split {
  std::int32_t copies, remainder;
};

struct Splitter {
  double count = 0;             ///< offspring
  double total = 1;             ///< sum of the whole numbers
  double inverse = 1;           ///< 1 / total
  double remainder_factor = 0;  ///< 2^bits / total
};

/// copies = floor(count whole / total), exactly: the quotient may be one off and is put right.
GLINT_INLINE Split split(std::int32_t whole, const Splitter& s) {
  const double product = s.count * whole;
  const auto guess = static_cast<std::int32_t>(product * s.inverse);
  const double rest = product - guess * s.total;
  const std::int32_t low = rest < 0 ? 1 : 0, high = rest >= s.total ? 1 : 0;
  const double fraction = rest + (low - high) * s.total;
  return {guess - low + high, static_cast<std::int32_t>(fraction * s.remainder_factor)};
}

/// Bits of the largest whole number, so that sums over `particles`, and products with `offspring`,
/// are exact.
int bits(std::size_t particles, std::size_t offspring);
Scale scale_of(float largest_weight, int bits);
Splitter splitter_of(double total, std::size_t offspring, int bits);
/// Points for `count` offspring of `total` mass; u from `word`.
Points points_of(double total, double count, std::uint32_t word);

}  // namespace glint::resample

// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/resample/shares.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace glint::resample {

int bits(std::size_t particles, std::size_t offspring) {
  const std::size_t most = std::max({particles, offspring, std::size_t{1}});
  return std::min(28, 52 - static_cast<int>(std::bit_width(most - 1)));
}

Scale scale_of(float largest_weight, int bits) {
  if (!(largest_weight > 0)) return {};
  int exponent = 0;
  std::frexp(largest_weight, &exponent);
  return {std::ldexp(1.0, bits - exponent), 0.5};
}

Splitter splitter_of(double total, std::size_t offspring, int bits) {
  return {static_cast<double>(offspring), total, 1 / total, std::ldexp(1.0, bits) / total};
}

Points points_of(double total, double count, std::uint32_t word) {
  const double u = ((word >> 8) + 0.5) * 0x1p-24;
  return {total > 0 ? count / total : 0, 1 - u};
}

}  // namespace glint::resample

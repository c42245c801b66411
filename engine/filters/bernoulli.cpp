// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/filters/bernoulli.hpp"

#include <algorithm>

namespace glint {
namespace {

// Neither certain nor impossible, or no frame could change it any more.
constexpr double kNearlyCertain = 1 - 1e-6;
constexpr double kLeast = 1e-100;

}  // namespace

double bernoulli_update(double existence, double survival, double ratio) {
  if (!(ratio > 0)) return 0;
  ratio = std::min(ratio, 1e300);  // infinite: out of the range of a double
  const double there = std::clamp(survival * existence, kLeast, kNearlyCertain);
  return there * ratio / (1 - there + there * ratio);
}

double ratio_of_mass(double mass, double before, double survival) {
  const double now = std::min(mass, kNearlyCertain);  // births add to it
  return now / (1 - now) / std::max(survival * before, kLeast);
}

}  // namespace glint

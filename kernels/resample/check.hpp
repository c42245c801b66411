// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <stdexcept>

#include "glint/kernels/resample/resample.hpp"

namespace glint::resample {

/// Throws as Resample says.
inline void check(const Resample::Args& args) {
  if (args.weights.empty() && !args.ancestors.empty()) {
    throw std::invalid_argument("resample needs a particle to draw offspring from");
  }
  if (std::max(args.weights.size(), args.ancestors.size()) > Resample::kMaxCount) {
    throw std::invalid_argument("resample takes at most 2^25 particles and as many offspring");
  }
}

}  // namespace glint::resample

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <tuple>

#include <Eigen/Core>

namespace glint {

/// Acceleration that fades at the rate `fading` and keeps its variance (Singer 1970; the SMM of
/// P-PMHT): dead reckoning within 1 / fading, constant velocity beyond.
struct Singer {
  static constexpr int kParts = 3;
  double fading = 0.2;  ///< alpha, 1 over the time constant [1/time], >= 0
  double variance = 2;  ///< sigma^2, of the acceleration [length^2/time^4]
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.fading, s.variance);
  }
};

/// Of one axis, over `step`, to 12 digits for every fading * step from 0 on.
Eigen::Matrix3d transition(const Singer& model, double step);
Eigen::Matrix3d process_noise(const Singer& model, double step);

}  // namespace glint

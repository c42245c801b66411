// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <span>
#include <stdexcept>

#include <Eigen/Eigenvalues>

#include "glint/engine/models/motion.hpp"

namespace glint {

/// What a filter believed after a scan, and the motion that led to it from the scan before.
template <int N>
struct FilteredStep {
  LinearMotion<N> motion;  ///< of the first step: not used
  Gaussian<N> belief;
};

/// Of a covariance, which models with noise of rank 1 may leave singular: directions without
/// variance carry nothing.
template <int N>
Eigen::Matrix<double, N, N> pseudo_inverse(const Eigen::Matrix<double, N, N>& covariance) {
  using Vector = Eigen::Matrix<double, N, 1>;
  constexpr double kLeast = 1e-13;  // of variances scaled to 1, whatever their units
  const Vector variance = covariance.diagonal();
  const Vector scale = (variance.array() > 0).select(variance.cwiseSqrt().cwiseInverse(), 0.0);
  const Eigen::Matrix<double, N, N> scaled = scale.asDiagonal() * covariance * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> principal(scaled);
  const Vector& length = principal.eigenvalues();
  const Vector inverse = (length.array() > kLeast).select(length.cwiseInverse(), 0.0);
  const Eigen::Matrix<double, N, N> axes = scale.asDiagonal() * principal.eigenvectors();
  return axes * inverse.asDiagonal() * axes.transpose();
}

/// Rauch, Tung and Striebel's recursion back over `steps`, oldest first, for any linear motion:
/// P-HPMHT (16). Over the whole history it gives the least-squares solution of every scan; over the
/// last L + 1 steps, smoothed[0] is the estimate of lag L. Throws std::invalid_argument unless
/// `smoothed` is as long as `steps`.
template <int N>
void smooth(std::span<const FilteredStep<N>> steps, std::span<Gaussian<N>> smoothed) {
  if (smoothed.size() != steps.size()) {
    throw std::invalid_argument("smoothing needs room for one belief a step");
  }
  if (steps.empty()) return;
  smoothed.back() = steps.back().belief;
  for (std::size_t t = steps.size() - 1; t-- > 0;) {
    const Gaussian<N>&filtered = steps[t].belief, &later = smoothed[t + 1];
    const LinearMotion<N>& motion = steps[t + 1].motion;
    Gaussian<N> predicted = filtered;
    predict(motion, predicted);
    const Eigen::Matrix<double, N, N> gain =
        filtered.covariance * motion.transition.transpose() * pseudo_inverse(predicted.covariance);
    smoothed[t].mean = filtered.mean + gain * (later.mean - predicted.mean);
    smoothed[t].covariance =
        filtered.covariance + gain * (later.covariance - predicted.covariance) * gain.transpose();
    symmetrise(smoothed[t].covariance);
  }
}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <vector>

#include <Eigen/Core>

#include "glint/engine/trackers/pmht/pmht.hpp"

namespace glint::bench {

/// E step of PMHT over all points and all targets: dense matrices by target and point, zero where
/// the point is outside the target's gate.
struct PlainWeights {
  Eigen::MatrixXd points;                  ///< 2 x points [px]
  Eigen::MatrixXd gated;                   ///< 1 or 0, targets x points
  std::vector<Eigen::MatrixXd> positions;  ///< by model: 2 x targets [px]
  Eigen::MatrixXd probability;             ///< of a target's models, targets x models

  PlainWeights(std::span<const PointMeasurement> seen, const Eigen::MatrixXd& expected,
               double gate);
  /// P-PMHT (16) with a class for clutter; the density of a target is P-MMPF (8) if models mix.
  Eigen::MatrixXd of(std::size_t model, const PmhtConfig& config) const;
  /// (23): x, y and weight of a target's centroid.
  Eigen::Vector3d centroid(const Eigen::MatrixXd& weights, std::size_t target) const;

 private:
  Eigen::MatrixXd densities(std::size_t model, double variance) const;
};

}  // namespace glint::bench

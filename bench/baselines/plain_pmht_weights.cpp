// SPDX-License-Identifier: Apache-2.0
#include "glint/bench/baselines/plain_pmht_weights.hpp"

#include <cmath>
#include <numbers>

namespace glint::bench {

using Eigen::Index;
using Eigen::MatrixXd;

PlainWeights::PlainWeights(std::span<const PointMeasurement> seen, const MatrixXd& expected,
                           double gate)
    : points(2, static_cast<Index>(seen.size())), gated(expected.cols(), points.cols()) {
  for (std::size_t i = 0; i < seen.size(); ++i) {
    points.col(static_cast<Index>(i)) << seen[i].x, seen[i].y;
  }
  for (Index s = 0; s < expected.cols(); ++s) {
    for (Index j = 0; j < points.cols(); ++j) {
      gated(s, j) = (points.col(j) - expected.col(s)).cwiseAbs().maxCoeff() <= gate;
    }
  }
}

MatrixXd PlainWeights::densities(std::size_t model, double variance) const {
  MatrixXd density(gated.rows(), gated.cols());
  for (Index s = 0; s < gated.rows(); ++s) {
    for (Index j = 0; j < gated.cols(); ++j) {
      const double distance = (points.col(j) - positions[model].col(s)).squaredNorm();
      density(s, j) =
          gated(s, j) * std::exp(-distance / (2 * variance)) / (2 * std::numbers::pi * variance);
    }
  }
  return density;
}

MatrixXd PlainWeights::of(std::size_t model, const PmhtConfig& config) const {
  MatrixXd density;
  if (config.association == PmhtAssociation::mixture) {
    density = MatrixXd::Zero(gated.rows(), gated.cols());
    for (std::size_t m = 0; m < positions.size(); ++m) {
      density += probability.col(static_cast<Index>(m)).asDiagonal() *
                 densities(m, config.measurement_variance);
    }
  } else {
    density = densities(model, config.measurement_variance);
  }
  const MatrixXd joint = config.detection * density;
  const Eigen::RowVectorXd all = joint.colwise().sum().array() + config.clutter_density;
  return joint.array().rowwise() / all.array();
}

Eigen::Vector3d PlainWeights::centroid(const MatrixXd& weights, std::size_t target) const {
  const Eigen::VectorXd own = weights.row(static_cast<Index>(target));
  Eigen::Vector3d centroid;
  centroid << points * own / own.sum(), own.sum();
  return centroid;
}

}  // namespace glint::bench

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include <Eigen/Core>

#include "glint/engine/filters/imm.hpp"

/// Interacting multiple models as one would write them in an afternoon: matrices of a size known at
/// run time, a measurement matrix, an inverse wherever the book has one. Models of one size, a scan
/// a frame.
namespace glint::bench {

struct PlainGaussian {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

/// The position of a state whose halves begin with one.
inline Eigen::Vector2d place_of(const PlainGaussian& state) {
  return {state.mean(0), state.mean(state.mean.size() / 2)};
}

struct PlainMode {
  Eigen::MatrixXd transition, noise;  ///< F, Q of a step of 1
  PlainGaussian belief;
};

/// A measured position, as one mode expects it.
struct PlainPrediction {
  Eigen::MatrixXd h, gain, innovation_covariance, inverse;
  Eigen::VectorXd expected;

  /// `noise`: covariance of the measured position.
  PlainPrediction(const PlainGaussian& predicted, const Eigen::MatrixXd& noise);
  double distance(const Eigen::VectorXd& point) const;  ///< squared, in sigmas
  double density(const Eigen::VectorXd& point) const;   ///< [1/px^2]
  PlainGaussian updated(const PlainGaussian& predicted, const Eigen::VectorXd& point) const;
};

struct PlainBank {
  std::vector<PlainMode> modes;
  Eigen::MatrixXd switching;
  Eigen::VectorXd probability;

  void mix();
  void predict();
  /// Models gain probability by how well they predicted.
  void weigh(const Eigen::VectorXd& likelihood);
  PlainGaussian combined() const;     ///< in the state of the models
  Eigen::Vector4d kinematic() const;  ///< [x vx y vy]
};

/// The same models and beliefs as `imm`, whose chain stays in each with probability `stay`.
PlainBank plain_bank(const Imm& imm, double stay);

/// The moments of several banks of the same models. Weights sum to 1.
struct PlainShare {
  double weight;
  const PlainBank* bank;
};
PlainBank mixed(const std::vector<PlainShare>& shares);

}  // namespace glint::bench

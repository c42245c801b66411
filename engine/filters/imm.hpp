// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <variant>
#include <vector>

#include "glint/engine/mode_probability.hpp"
#include "glint/engine/models/motion.hpp"

namespace glint {

/// A motion model and what it believes.
template <class Model>
struct Mode {
  Model model;
  Belief<Model> belief;
};

/// The one list of motion models that a bank may be made of.
using AnyMode = std::variant<Mode<ConstantVelocity>, Mode<ConstantAcceleration>>;

/// A bank of Kalman filters, one a motion model, between which a target switches as a Markov chain
/// (Blom and Bar-Shalom 1988). One cycle is mix(), predict(), an update of every mode's belief by
/// the caller, and weigh(). Models may be of unlike dimension.
class Imm {
 public:
  using Switching = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0,
                                  ModeProbability::kCapacity, ModeProbability::kCapacity>;

  /// `switching`: probability of a step from the row's model to the column's; rows are normalised.
  /// `probability`: of each model at the start. Throws std::invalid_argument if the sizes are not
  /// those of `modes`, there are none or more than ModeProbability::kCapacity, or a number is
  /// negative or a row is zero.
  Imm(std::vector<AnyMode> modes, const Switching& switching, const ModeProbability& probability);

  /// Each model starts from a mixture of what all believed, by how likely each leads to it; the
  /// probabilities become the predicted ones.
  void mix();
  void predict(double step);  ///< [frames]
  /// Models gain probability by how well they predicted: `log_likelihood`, one a model.
  void weigh(std::span<const double> log_likelihood);

  std::vector<AnyMode>& modes() { return modes_; }
  const std::vector<AnyMode>& modes() const { return modes_; }
  const ModeProbability& probability() const { return probability_; }
  /// Position and velocity [x vx y vy], moments of the mixture.
  Gaussian<4> combined() const;

 private:
  std::vector<AnyMode> modes_, before_;  // before_ is here so that mixing allocates nothing
  Switching switching_;
  ModeProbability probability_;
};

}  // namespace glint

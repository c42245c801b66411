// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include "glint/engine/filters/mode_probability.hpp"
#include "glint/engine/filters/motion.hpp"
#include "glint/engine/filters/short_list.hpp"

namespace glint {

/// A motion model and what it believes.
template <class Model, int Axes = 2>
struct Mode {
  Model model;
  Belief<Model, Axes> belief;

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.model, s.belief);
  }
};

/// The one list of motion models that a bank may be made of.
template <int Axes>
using ModeOf = std::variant<Mode<ConstantVelocity, Axes>, Mode<ConstantAcceleration, Axes>,
                            Mode<NearlyConstantVelocity, Axes>, Mode<WienerAcceleration, Axes>,
                            Mode<Singer, Axes>, Mode<CoordinatedTurn, Axes>>;
using AnyMode = ModeOf<2>;

/// Probability of a step from the row's model to the column's.
using Switching = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostModes, kMostModes>;

/// Scales each row to sum to 1, since a chain that leaks biases every estimate that is mixed by it
/// (P-PMHT (33) sums to 0.999). Returns a sentence for each row that was off by more than rounding.
/// Throws std::invalid_argument if a number is negative or a row is zero.
std::vector<std::string> normalise_rows(Switching& switching);

/// Of `models` models: each stays with probability `stay`, and goes to any other alike.
Switching staying(std::size_t models, double stay);

/// Models gain probability by how well they predicted: `log_likelihood`, one a model. As it was if
/// none predicted anything.
ModeProbability weighed(const ModeProbability& probability, std::span<const double> log_likelihood);

/// A bank of Kalman filters, one a motion model, between which a target switches as a Markov chain
/// (Blom and Bar-Shalom 1988). One cycle is mix(), predict(), an update of every mode's belief by
/// the caller, and weigh(). Models may be of unlike dimension. It is a value: neither copies nor a
/// cycle allocate.
template <int Axes>
class ImmOf {
 public:
  using Modes = ShortList<ModeOf<Axes>, kMostModes>;

  /// Of no models: to be restored.
  ImmOf() = default;

  /// `switching`: rows are normalised. `probability`: of each model at the start. Throws
  /// std::invalid_argument if the sizes are not those of `modes`, there are none, or as
  /// normalise_rows() does.
  ImmOf(const Modes& modes, const Switching& switching, const ModeProbability& probability);

  /// Each model starts from a mixture of what all believed, by how likely each leads to it; the
  /// probabilities become the predicted ones.
  void mix();
  void predict(double step);
  void weigh(std::span<const double> log_likelihood) {
    probability_ = weighed(probability_, log_likelihood);
  }

  Modes& modes() { return modes_; }
  const Modes& modes() const { return modes_; }
  const ModeProbability& probability() const { return probability_; }
  /// One a model, together 1.
  void set_probability(const ModeProbability& probability) { probability_ = probability; }
  /// Position and velocity [x vx y vy (z vz)], moments of the mixture.
  Gaussian<2 * Axes> combined() const;
  /// Has the same models in the same order, whatever they believe.
  bool alike(const ImmOf& other) const;

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.probability_, s.switching_, s.modes_);
  }
  void restored() const;

 private:
  ModeProbability probability_;
  Switching switching_;
  Modes modes_;
};

// Whoever needs another number of axes instantiates it in one unit, with imm_steps.hpp.
extern template class ImmOf<2>;
using Imm = ImmOf<2>;

}  // namespace glint

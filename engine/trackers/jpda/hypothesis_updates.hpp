// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <variant>
#include <vector>

#include "glint/engine/trackers/jpda/bank_mixture.hpp"
#include "glint/engine/trackers/jpda/bank_prediction.hpp"

namespace glint {

/// The hypotheses of a scan, one after another, updated by each point of their target's gate: by
/// one Kalman filter a model, P-JPDA (42)-(48). The covariance after an update does not depend on
/// the point, so there is one a model and not one a point.
template <class Sensor>
class HypothesisUpdates {
 public:
  using Bank = ImmOf<Sensor::kAxes>;

  /// `detection`: probability that a target gives a point, P_D.
  explicit HypothesisUpdates(double detection) : detection_(detection) {}

  void clear() { covariances_.clear(), first_.clear(), updates_.clear(); }
  /// The next hypothesis. `gate`: numbers of the `points` that its target may have. Appends to
  /// `log_weight` ln(1 - P_D), that the target has none of them, and for each
  /// ln(P_D p(point | hypothesis)) [1/volume], the sum over the models of (38).
  void add(const Bank& predicted, const BankPrediction<Sensor>& expected,
           std::span<const Measurement<Sensor>> points, std::span<const std::uint32_t> gate,
           std::vector<double>& log_weight);

  /// Of the models, if the hypothesis has point number `point` of its gate.
  const ModeProbability& probability(std::size_t hypothesis, std::size_t point) const {
    return updates_[first_[hypothesis] + point].probability;
  }
  /// What model number `mode`, of N numbers, then believes.
  template <int N>
  ComponentBelief<N> belief(std::size_t hypothesis, std::size_t point, std::size_t mode) const {
    const Mean& mean = updates_[first_[hypothesis] + point].mean[mode];
    const auto& model = belief_of<N>(covariances_[hypothesis][mode]);
    return {mean.template head<N>(), &model.covariance};
  }

 private:
  using Mean = Eigen::Matrix<double, 3 * Sensor::kAxes, 1>;  // of N numbers the first N
  struct Update {
    ModeProbability probability;
    ShortList<Mean, kMostModes> mean;  // by model
  };

  template <int N>
  void update_model(const Gaussian<N>& predicted, const ModelPrediction<Sensor, N>& expected,
                    std::size_t mode, std::span<const Measurement<Sensor>> points,
                    std::span<const std::uint32_t> gate, std::span<Update> updates);
  double weigh_models(const ModeProbability& predicted, std::size_t point, Update& update) const;

  double detection_;
  std::vector<typename Bank::Modes> covariances_;  // by hypothesis, after an update
  std::vector<std::size_t> first_;                 // by hypothesis: its first in updates_
  std::vector<Update> updates_;                    // by hypothesis and point
  std::vector<double> log_likelihood_;             // of the hypothesis at hand, by point and model
};

template <class Sensor>
void HypothesisUpdates<Sensor>::add(const Bank& predicted, const BankPrediction<Sensor>& expected,
                                    std::span<const Measurement<Sensor>> points,
                                    std::span<const std::uint32_t> gate,
                                    std::vector<double>& log_weight) {
  const std::size_t modes = predicted.modes().size();
  Update empty{predicted.probability(), {}};
  for (std::size_t j = 0; j < modes; ++j) empty.mean.push_back(Mean::Zero());
  first_.push_back(updates_.size());
  updates_.resize(updates_.size() + gate.size(), empty);
  const std::span updates = std::span(updates_).last(gate.size());
  covariances_.push_back(predicted.modes());
  log_likelihood_.assign(gate.size() * modes, 0);
  for (std::size_t j = 0; j < modes; ++j) {
    std::visit(
        [&]<class Model>(const Mode<Model, Sensor::kAxes>& mode) {
          using Expected = ModelPrediction<Sensor, Sensor::kAxes * Model::kParts>;
          update_model(mode.belief, std::get<Expected>(expected[j]), j, points, gate, updates);
        },
        predicted.modes()[j]);
  }
  log_weight.push_back(std::log(1 - detection_));
  for (std::size_t i = 0; i < gate.size(); ++i) {
    log_weight.push_back(weigh_models(predicted.probability(), i, updates[i]));
  }
}

template <class Sensor>
template <int N>
void HypothesisUpdates<Sensor>::update_model(const Gaussian<N>& predicted,
                                             const ModelPrediction<Sensor, N>& expected,
                                             std::size_t mode,
                                             std::span<const Measurement<Sensor>> points,
                                             std::span<const std::uint32_t> gate,
                                             std::span<Update> updates) {
  auto& covariance = belief_of<N>(covariances_.back()[mode]).covariance;
  covariance -= expected.gain * expected.covariance * expected.gain.transpose();  // (47)
  symmetrise(covariance);
  const std::size_t modes = covariances_.back().size();
  for (std::size_t i = 0; i < gate.size(); ++i) {
    const Measurement<Sensor>& point = points[gate[i]];
    updates[i].mean[mode].template head<N>() =
        predicted.mean + expected.gain * expected.innovation(point);  // (41), (44)
    log_likelihood_[i * modes + mode] = expected.log_density(point);
  }
}

/// Sets the probabilities of the models given the point, (52); returns ln(P_D p(point)).
template <class Sensor>
double HypothesisUpdates<Sensor>::weigh_models(const ModeProbability& predicted, std::size_t point,
                                               Update& update) const {
  const std::size_t modes = predicted.size();
  const std::span own = std::span(log_likelihood_).subspan(point * modes, modes);
  const double largest = *std::ranges::max_element(own);
  double sum = 0;
  for (std::size_t j = 0; j < modes; ++j) sum += predicted[j] * std::exp(own[j] - largest);
  update.probability = weighed(predicted, own);
  return std::log(detection_) + largest + std::log(sum);
}

}  // namespace glint

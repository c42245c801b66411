// SPDX-License-Identifier: Apache-2.0
#include "glint/bench/baselines/plain_pmht.hpp"

#include <algorithm>

namespace glint::bench {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

void PlainPmht::start(double x, double y, double vx, double vy) {
  targets_.push_back({plain_bank(pmht_bank(config_, {{x, y}, {vx, vy}, 1}), config_.stay), {}, {}});
}

std::vector<Eigen::Vector4d> PlainPmht::states() const {
  std::vector<Eigen::Vector4d> states;
  for (const Target& target : targets_) states.push_back(target.bank.kinematic());
  return states;
}

void PlainPmht::step(std::span<const PointMeasurement> points) {
  PlainWeights weights = predict(points);
  for (int i = 0; i < config_.iterations; ++i) {
    if (iterate(weights, i == 0) <= config_.tolerance) break;
  }
  for (Target& target : targets_) take_in(target);
}

PlainWeights PlainPmht::predict(std::span<const PointMeasurement> points) {
  const auto targets = static_cast<Index>(targets_.size());
  const std::size_t models = targets_[0].bank.modes.size();
  MatrixXd expected(2, targets), probability(targets, static_cast<Index>(models));
  std::vector<MatrixXd> positions(models, MatrixXd(2, targets));
  for (Index s = 0; s < targets; ++s) {
    Target& target = targets_[static_cast<std::size_t>(s)];
    target.bank.mix(), target.bank.predict();
    expected.col(s) = place_of(target.bank.combined());
    probability.row(s) = target.bank.probability.transpose();
    target.estimates.clear(), target.first.resize(models);
    for (std::size_t m = 0; m < models; ++m) {
      target.estimates.push_back(target.bank.modes[m].belief);
      positions[m].col(s) = place_of(target.estimates[m]);
    }
  }
  PlainWeights weights(points, expected, config_.gate);
  weights.positions = positions, weights.probability = probability;
  return weights;
}

/// Returns how far the position that moved most has moved [px].
double PlainPmht::iterate(PlainWeights& weights, bool first) {
  std::vector<MatrixXd> z;
  for (std::size_t m = 0; m < weights.positions.size(); ++m) z.push_back(weights.of(m, config_));
  double furthest = 0;
  for (std::size_t s = 0; s < targets_.size(); ++s) {
    for (std::size_t m = 0; m < z.size(); ++m) {
      const Eigen::Vector3d centroid = weights.centroid(z[m], s);
      if (first) targets_[s].first[m] = centroid;
      targets_[s].estimates[m] = maximise(targets_[s].bank.modes[m].belief, centroid);
      auto position = weights.positions[m].col(static_cast<Index>(s));
      const Eigen::Vector2d at = place_of(targets_[s].estimates[m]);
      furthest = std::max(furthest, (at - position).norm());
      position = at;
    }
  }
  return furthest;
}

/// (24), (A.11).
PlainGaussian PlainPmht::maximise(const PlainGaussian& predicted,
                                  const Eigen::Vector3d& centroid) const {
  if (!(centroid(2) >= PmhtCentroid::kLeastWeight)) return predicted;
  const MatrixXd noise = config_.measurement_variance / centroid(2) * MatrixXd::Identity(2, 2);
  return PlainPrediction(predicted, noise).updated(predicted, centroid.head(2));
}

/// (25), (27).
void PlainPmht::take_in(Target& target) const {
  VectorXd likelihood(target.bank.probability.size());
  bool seen = false;
  for (std::size_t m = 0; m < target.first.size(); ++m) {
    const Eigen::Vector3d& centroid = target.first[m];
    const bool has_points = centroid(2) >= PmhtCentroid::kLeastWeight;
    const double weight = has_points ? centroid(2) : PmhtCentroid::kLeastWeight;
    const MatrixXd noise = config_.measurement_variance / weight * MatrixXd::Identity(2, 2);
    const PlainPrediction expected(target.bank.modes[m].belief, noise);
    const VectorXd at = has_points ? VectorXd(centroid.head(2)) : expected.expected;
    likelihood(static_cast<Index>(m)) = weight * expected.density(at);
    seen = seen || has_points;
  }
  if (seen) target.bank.weigh(likelihood);
  for (std::size_t m = 0; m < target.first.size(); ++m) {
    target.bank.modes[m].belief = target.estimates[m];
  }
}

}  // namespace glint::bench

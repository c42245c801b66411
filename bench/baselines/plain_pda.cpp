// SPDX-License-Identifier: Apache-2.0
#include "glint/bench/baselines/plain_pda.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace glint::bench {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd place_of(const PointMeasurement& point) { return Eigen::Vector2d(point.x, point.y); }

}  // namespace

void PlainPda::start(double x, double y, double vx, double vy, double amplitude) {
  Mode<ConstantVelocity> slow{{config_.noise_slow}, {}};
  slow.belief.mean << x, vx, y, vy;
  const double p = config_.measurement_variance, v = config_.velocity_sd * config_.velocity_sd;
  slow.belief.covariance.diagonal() << p, v, p, v;
  const Mode<ConstantVelocity> fast{{config_.noise_fast}, slow.belief};
  const Imm imm({slow, fast}, staying(2, config_.stay), {0.5, 0.5});
  targets_.push_back({plain_bank(imm, config_.stay), TargetAmplitude(amplitude)});
}

std::vector<Eigen::Vector4d> PlainPda::states() const {
  std::vector<Eigen::Vector4d> states;
  for (const Target& target : targets_) states.push_back(target.bank.kinematic());
  return states;
}

void PlainPda::step(std::span<const PointMeasurement> points) {
  const MatrixXd noise = config_.measurement_variance * MatrixXd::Identity(2, 2);
  double threshold = std::numeric_limits<double>::infinity();
  for (const PointMeasurement& p : points)
    threshold = std::min(threshold, static_cast<double>(p.amplitude));
  for (Target& target : targets_) {
    target.bank.mix(), target.bank.predict();
    std::vector<PointMeasurement> gated;
    for (const PointMeasurement& point : points) {
      bool inside = false;
      for (const PlainMode& mode : target.bank.modes) {
        const PlainPrediction expected(mode.belief, noise);
        inside = inside || expected.distance(place_of(point)) <= config_.gate;
      }
      if (inside) gated.push_back(point);
    }
    update(target, gated, threshold);
  }
}

void PlainPda::update(Target& target, const std::vector<PointMeasurement>& gated,
                      double threshold) const {
  const MatrixXd noise = config_.measurement_variance * MatrixXd::Identity(2, 2);
  const AmplitudeModel model = config_.amplitude;
  const double miss = 1 - config_.detection * (1 - std::exp(-config_.gate / 2));
  VectorXd likelihood(static_cast<Index>(target.bank.modes.size()));
  MatrixXd beta(likelihood.size(), static_cast<Index>(gated.size()) + 1);
  for (std::size_t j = 0; j < target.bank.modes.size(); ++j) {
    const auto row = static_cast<Index>(j);
    PlainGaussian& belief = target.bank.modes[j].belief;
    const PlainPrediction expected(belief, noise);
    beta(row, 0) = miss;
    for (std::size_t i = 0; i < gated.size(); ++i) {
      const auto a = static_cast<double>(gated[i].amplitude);
      beta(row, static_cast<Index>(i) + 1) =
          config_.detection / config_.clutter_density * expected.density(place_of(gated[i])) *
          std::exp(target.amplitude.log_ratio(model, a, threshold));
    }
    likelihood(row) = beta.row(row).sum();
    beta.row(row) /= likelihood(row);
    VectorXd combined = VectorXd::Zero(2);
    MatrixXd spread = MatrixXd::Zero(2, 2);
    for (std::size_t i = 0; i < gated.size(); ++i) {
      const VectorXd innovation = place_of(gated[i]) - expected.expected;
      combined += beta(row, static_cast<Index>(i) + 1) * innovation;
      spread += beta(row, static_cast<Index>(i) + 1) * innovation * innovation.transpose();
    }
    spread -= combined * combined.transpose();
    belief.mean += expected.gain * combined;
    belief.covariance += expected.gain *
                         (spread - (1 - beta(row, 0)) * expected.innovation_covariance) *
                         expected.gain.transpose();
  }
  target.bank.weigh(likelihood);
  double own = 0, amplitude = 0;
  for (std::size_t i = 0; i < gated.size(); ++i) {
    const double share = target.bank.probability.dot(beta.col(static_cast<Index>(i) + 1));
    own += share, amplitude += share * static_cast<double>(gated[i].amplitude);
  }
  if (own > 0) target.amplitude.update(amplitude / own, own);
}

}  // namespace glint::bench

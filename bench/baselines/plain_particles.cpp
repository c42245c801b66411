// SPDX-License-Identifier: Apache-2.0
#include "glint/bench/baselines/plain_particles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/Cholesky>

namespace glint::bench {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kCollapse = 25;  // squared distance of the nearest particle over the variance

/// A square root of a covariance, which may be singular.
MatrixXd root_of(const MatrixXd& covariance) {
  const Eigen::LDLT<MatrixXd> factors(covariance);
  const VectorXd scale = factors.vectorD().cwiseMax(0).cwiseSqrt();
  return factors.transpositionsP().transpose() * MatrixXd(factors.matrixL()) * scale.asDiagonal();
}

PlainGaussian moments(const std::vector<VectorXd>& cloud, const std::vector<double>& weights) {
  const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
  const Index size = cloud[0].size();
  PlainGaussian result{VectorXd::Zero(size), MatrixXd::Zero(size, size)};
  for (std::size_t p = 0; p < cloud.size(); ++p) result.mean += weights[p] / all * cloud[p];
  for (std::size_t p = 0; p < cloud.size(); ++p) {
    const VectorXd off = cloud[p] - result.mean;
    result.covariance += weights[p] / all * off * off.transpose();
  }
  return result;
}

}  // namespace

void PlainParticles::start(double x, double y, double vx, double vy) {
  Target target{
      plain_bank(pmht_bank(config_, {{x, y}, {vx, vy}, 1}), config_.stay), {}, {}, {}, {}};
  for (const PlainMode& mode : target.bank.modes) target.clouds.push_back(draw(mode.belief));
  target.collapsed.assign(target.clouds.size(), false);
  target.first.resize(target.clouds.size()), target.last.resize(target.clouds.size());
  targets_.push_back(target);
}

std::vector<Eigen::Vector4d> PlainParticles::states() const {
  std::vector<Eigen::Vector4d> states;
  for (const Target& target : targets_) states.push_back(target.bank.kinematic());
  return states;
}

VectorXd PlainParticles::noise(const MatrixXd& root) {
  VectorXd normals(root.cols());
  for (Index i = 0; i < normals.size(); ++i) normals(i) = normal_(random_);
  return root * normals;
}

PlainParticles::Cloud PlainParticles::draw(const PlainGaussian& belief) {
  const MatrixXd root = root_of(belief.covariance);
  Cloud cloud;
  for (int p = 0; p < config_.particles; ++p) cloud.emplace_back(belief.mean + noise(root));
  return cloud;
}

void PlainParticles::step(std::span<const PointMeasurement> points) {
  for (Target& target : targets_) move(target);
  PlainWeights weights = predict(points);
  for (int i = 0; i < config_.iterations; ++i) {
    if (iterate(weights, i == 0) <= config_.tolerance) break;
  }
  for (Target& target : targets_) take_in(target);
}

/// P-MMPF step (b).
void PlainParticles::move(Target& target) {
  target.bank.mix();
  for (std::size_t m = 0; m < target.clouds.size(); ++m) {
    PlainMode& mode = target.bank.modes[m];
    if (target.collapsed[m]) target.clouds[m] = draw(mode.belief);
    const MatrixXd root = root_of(mode.noise);
    for (VectorXd& particle : target.clouds[m]) {
      particle = mode.transition * particle + noise(root);
    }
    mode.belief = moments(target.clouds[m], std::vector<double>(target.clouds[m].size(), 1.0));
  }
}

PlainWeights PlainParticles::predict(std::span<const PointMeasurement> points) {
  const auto targets = static_cast<Index>(targets_.size());
  const std::size_t models = targets_[0].clouds.size();
  MatrixXd expected(2, targets), probability(targets, static_cast<Index>(models));
  std::vector<MatrixXd> positions(models, MatrixXd(2, targets));
  for (Index s = 0; s < targets; ++s) {
    const PlainBank& bank = targets_[static_cast<std::size_t>(s)].bank;
    expected.col(s) = place_of(bank.combined());
    probability.row(s) = bank.probability.transpose();
    for (std::size_t m = 0; m < models; ++m) positions[m].col(s) = place_of(bank.modes[m].belief);
  }
  PlainWeights weights(points, expected, config_.gate);
  weights.positions = positions, weights.probability = probability;
  return weights;
}

std::pair<std::vector<double>, double> PlainParticles::weigh(const Cloud& cloud,
                                                             const Eigen::Vector3d& at) const {
  std::vector<double> weights;
  double nearest = std::numeric_limits<double>::infinity();
  for (const VectorXd& particle : cloud) {
    const double dx = particle(0) - at(0), dy = particle(particle.size() / 2) - at(1);
    weights.push_back(dx * dx + dy * dy);
    nearest = std::min(nearest, weights.back());
  }
  const double variance = config_.measurement_variance;
  for (double& w : weights) w = std::exp(-(w - nearest) / (2 * variance));
  return {weights, nearest / variance};
}

/// Returns how far the position that moved most has moved [px].
double PlainParticles::iterate(PlainWeights& weights, bool first) {
  std::vector<MatrixXd> z;
  for (std::size_t m = 0; m < weights.positions.size(); ++m) z.push_back(weights.of(m, config_));
  double furthest = 0;
  for (std::size_t s = 0; s < targets_.size(); ++s) {
    Target& target = targets_[s];
    for (std::size_t m = 0; m < z.size(); ++m) {
      target.last[m] = weights.centroid(z[m], s);
      if (first) target.first[m] = target.last[m];
      Eigen::Vector2d at = place_of(target.bank.modes[m].belief);
      if (target.last[m](2) >= PmhtCentroid::kLeastWeight) {
        const auto [own, nearest] = weigh(target.clouds[m], target.last[m]);
        if (nearest <= kCollapse) at = place_of(moments(target.clouds[m], own));
      }
      auto position = weights.positions[m].col(static_cast<Index>(s));
      furthest = std::max(furthest, (at - position).norm());
      position = at;
    }
  }
  return furthest;
}

/// P-MMPF step (a) iv to vi.
void PlainParticles::take_in(Target& target) {
  VectorXd likelihood = VectorXd::Ones(target.bank.probability.size());
  bool seen = false;
  for (std::size_t m = 0; m < target.clouds.size(); ++m) {
    if (target.first[m](2) >= PmhtCentroid::kLeastWeight) {
      const auto [weights, nearest] = weigh(target.clouds[m], target.first[m]);
      likelihood(static_cast<Index>(m)) =
          std::accumulate(weights.begin(), weights.end(), 0.0) * std::exp(-nearest / 2);
      seen = true;
    }
    target.collapsed[m] = false;
    if (!(target.last[m](2) >= PmhtCentroid::kLeastWeight)) continue;
    const auto [weights, nearest] = weigh(target.clouds[m], target.last[m]);
    target.collapsed[m] = nearest > kCollapse;
    if (target.collapsed[m]) continue;
    target.bank.modes[m].belief = moments(target.clouds[m], weights);
    target.clouds[m] = resample(target.clouds[m], weights);
  }
  if (!seen) return;
  if (std::ranges::all_of(target.collapsed, std::identity{})) {
    likelihood = target.bank.probability.cwiseInverse();
  }
  target.bank.weigh(likelihood);
}

/// Each particle as often as it weighs, rounded down; the rest by draws.
PlainParticles::Cloud PlainParticles::resample(const Cloud& cloud,
                                               const std::vector<double>& weights) {
  const auto count = static_cast<double>(cloud.size());
  const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
  Cloud resampled;
  std::vector<double> rest;
  for (std::size_t p = 0; p < cloud.size(); ++p) {
    const double copies = std::floor(count * weights[p] / all);
    resampled.insert(resampled.end(), static_cast<std::size_t>(copies), cloud[p]);
    rest.push_back(count * weights[p] / all - copies);
  }
  std::discrete_distribution<std::size_t> draws(rest.begin(), rest.end());
  while (resampled.size() < cloud.size()) resampled.push_back(cloud[draws(random_)]);
  return resampled;
}

}  // namespace glint::bench

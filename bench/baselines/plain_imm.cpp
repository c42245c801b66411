// SPDX-License-Identifier: Apache-2.0
#include "glint/bench/baselines/plain_imm.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/LU>

namespace glint::bench {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

PlainGaussian moments(const std::vector<PlainGaussian>& parts, const std::vector<double>& weights) {
  PlainGaussian all{VectorXd::Zero(parts[0].mean.size()),
                    MatrixXd::Zero(parts[0].mean.size(), parts[0].mean.size())};
  for (std::size_t i = 0; i < parts.size(); ++i) all.mean += weights[i] * parts[i].mean;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const VectorXd off = parts[i].mean - all.mean;
    all.covariance += weights[i] * (parts[i].covariance + off * off.transpose());
  }
  return all;
}

}  // namespace

PlainPrediction::PlainPrediction(const PlainGaussian& predicted, const MatrixXd& noise)
    : h(MatrixXd::Zero(2, predicted.mean.size())) {
  h(0, 0) = h(1, predicted.mean.size() / 2) = 1;
  expected = h * predicted.mean;
  innovation_covariance = h * predicted.covariance * h.transpose() + noise;
  inverse = innovation_covariance.inverse();
  gain = predicted.covariance * h.transpose() * inverse;
}

double PlainPrediction::distance(const VectorXd& point) const {
  const VectorXd innovation = point - expected;
  return innovation.dot(inverse * innovation);
}

double PlainPrediction::density(const VectorXd& point) const {
  return std::exp(-distance(point) / 2) /
         (2 * std::numbers::pi * std::sqrt(innovation_covariance.determinant()));
}

PlainGaussian PlainPrediction::updated(const PlainGaussian& predicted,
                                       const VectorXd& point) const {
  return {predicted.mean + gain * (point - expected),
          predicted.covariance - gain * innovation_covariance * gain.transpose()};
}

void PlainBank::mix() {
  const VectorXd predicted = switching.transpose() * probability;
  std::vector<PlainGaussian> before;
  for (const PlainMode& mode : modes) before.push_back(mode.belief);
  for (std::size_t j = 0; j < modes.size(); ++j) {
    std::vector<double> weights;
    for (std::size_t i = 0; i < modes.size(); ++i) {
      const auto from = static_cast<Eigen::Index>(i), to = static_cast<Eigen::Index>(j);
      weights.push_back(switching(from, to) * probability(from) / predicted(to));
    }
    modes[j].belief = moments(before, weights);
  }
  probability = predicted;
}

void PlainBank::predict() {
  for (PlainMode& mode : modes) {
    mode.belief.mean = mode.transition * mode.belief.mean;
    mode.belief.covariance =
        mode.transition * mode.belief.covariance * mode.transition.transpose() + mode.noise;
  }
}

void PlainBank::weigh(const VectorXd& likelihood) {
  const VectorXd product = probability.cwiseProduct(likelihood);
  if (product.sum() > 0) probability = product / product.sum();
}

PlainGaussian PlainBank::combined() const {
  std::vector<PlainGaussian> parts;
  std::vector<double> weights;
  for (std::size_t j = 0; j < modes.size(); ++j) {
    parts.push_back(modes[j].belief);
    weights.push_back(probability(static_cast<Eigen::Index>(j)));
  }
  return moments(parts, weights);
}

Eigen::Vector4d PlainBank::kinematic() const {
  const VectorXd x = combined().mean;
  return {x(0), x(1), x(x.size() / 2), x(x.size() / 2 + 1)};
}

PlainBank plain_bank(const Imm& imm, double stay) {
  PlainBank bank;
  bank.switching = staying(imm.modes().size(), stay);
  bank.probability.resize(static_cast<Eigen::Index>(imm.modes().size()));
  for (std::size_t j = 0; j < imm.modes().size(); ++j) {
    bank.probability(static_cast<Eigen::Index>(j)) = imm.probability()[j];
    std::visit(
        [&](const auto& mode) {
          const auto motion = linear_motion<2>(mode.model, 1);
          bank.modes.push_back(
              {motion.transition, motion.noise, {mode.belief.mean, mode.belief.covariance}});
        },
        imm.modes()[j]);
  }
  return bank;
}

PlainBank mixed(const std::vector<PlainShare>& shares) {
  PlainBank all = *shares[0].bank;
  for (std::size_t j = 0; j < all.modes.size(); ++j) {
    const auto index = static_cast<Eigen::Index>(j);
    double sum = 0;
    for (const PlainShare& share : shares) sum += share.weight * share.bank->probability(index);
    all.probability(index) = sum;
    if (!(sum > 0)) continue;
    std::vector<PlainGaussian> parts;
    std::vector<double> weights;
    for (const PlainShare& share : shares) {
      parts.push_back(share.bank->modes[j].belief);
      weights.push_back(share.weight * share.bank->probability(index) / sum);
    }
    all.modes[j].belief = moments(parts, weights);
  }
  return all;
}

}  // namespace glint::bench

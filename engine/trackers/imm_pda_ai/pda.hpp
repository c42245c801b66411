// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <span>
#include <type_traits>

#include "glint/engine/filters/gaussian.hpp"

namespace glint {

/// Probabilities that a target gave none (`beta[0]`) or the i-th (`beta[i + 1]`) of the points in
/// its gate, at most one being its own (Bar-Shalom and Tse 1975, Poisson clutter).
/// `log_ratio[i]`: ln(P_D p(z_i | target) / clutter density), amplitude included;
/// `miss`: probability that its own point is not among them, 1 - P_D P_G. `beta` has room for one
/// more than `log_ratio`. Returns ln of the likelihood of the points over that of clutter alone.
double pda_weights(std::span<const double> log_ratio, double miss, std::span<double> beta);

/// Moments of the mixture over the associations: Kalman updates of `predicted` with each of
/// `points`, and none. `beta` as pda_weights() gives it for them.
template <int N, int M, int Azimuth>
Gaussian<N> pda_update(const Gaussian<N>& predicted,
                       const MeasurementPrediction<N, M, Azimuth>& expected,
                       std::type_identity_t<std::span<const Eigen::Matrix<double, M, 1>>> points,
                       std::span<const double> beta) {
  Eigen::Matrix<double, M, 1> combined = Eigen::Matrix<double, M, 1>::Zero();
  Eigen::Matrix<double, M, M> spread = Eigen::Matrix<double, M, M>::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Matrix<double, M, 1> innovation = expected.innovation(points[i]);
    combined += beta[i + 1] * innovation;
    spread += beta[i + 1] * innovation * innovation.transpose();
  }
  spread -= combined * combined.transpose();
  const auto& k = expected.gain;
  Gaussian<N> result;
  result.mean = predicted.mean + k * combined;
  result.covariance = predicted.covariance -
                      (1 - beta[0]) * k * expected.covariance * k.transpose() +
                      k * spread * k.transpose();
  symmetrise(result.covariance);
  return result;
}

}  // namespace glint

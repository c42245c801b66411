// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/pmht/kalman_bank.hpp"

#include <algorithm>
#include <array>

namespace glint {
namespace {

template <int N>
Gaussian<2> position_of(const Gaussian<N>& state) {
  Gaussian<2> position;
  position.mean << state.mean(0), state.mean(N / 2);
  position.covariance << state.covariance(0, 0), state.covariance(0, N / 2),
      state.covariance(N / 2, 0), state.covariance(N / 2, N / 2);
  return position;
}

}  // namespace

PmhtMode KalmanBank::mode(std::size_t model) const {
  const auto position = [](const auto& mode) { return position_of(mode.belief).mean; };
  return {std::visit(position, imm_.modes()[model]), imm_.probability()[model]};
}

Eigen::Vector2d KalmanBank::maximise(std::size_t model, const PmhtCentroid& centroid) const {
  return std::visit(
      [&](const auto& mode) -> Eigen::Vector2d {
        return pmht_update(position_of(mode.belief), centroid, variance_).mean;
      },
      imm_.modes()[model]);
}

/// The probability of a model is updated from the predicted one; (27) prints that of the last scan.
void KalmanBank::update(std::span<const PmhtCentroid> first, std::span<const PmhtCentroid> last) {
  std::array<double, kMostModes> log_likelihood{};
  for (std::size_t m = 0; m < imm_.modes().size(); ++m) {
    std::visit(
        [&](auto& mode) {
          log_likelihood[m] = pmht_log_likelihood(mode.belief, first[m], variance_);
          mode.belief = pmht_update(mode.belief, last[m], variance_);
        },
        imm_.modes()[m]);
  }
  if (std::ranges::any_of(first, &PmhtCentroid::seen)) {
    imm_.weigh(std::span(log_likelihood).first(imm_.modes().size()));  // P-PMHT (27)
  }
}

}  // namespace glint

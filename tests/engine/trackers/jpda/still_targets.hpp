// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>
#include <initializer_list>
#include <numbers>

#include "glint/engine/filters/imm.hpp"

namespace glint::test {

/// At (x, 0), and known not to move; `variance` of the position along each axis.
inline Gaussian<4> still(double x, double variance) {
  Gaussian<4> state;
  state.mean << x, 0, 0, 0;
  state.covariance.setZero();
  state.covariance(0, 0) = state.covariance(2, 2) = variance;
  return state;
}

/// A bank of models without process noise that never change into each other, equally likely. The
/// position alone is uncertain: along each axis, it is a scalar Kalman filter.
inline Imm still_bank(double x, std::initializer_list<double> variances) {
  Imm::Modes modes;
  ModeProbability probability;
  for (const double variance : variances) {
    modes.push_back(Mode<NearlyConstantVelocity>{{0}, still(x, variance)});
    probability.push_back(1 / static_cast<double>(variances.size()));
  }
  return {modes, staying(variances.size(), 1), probability};
}

/// Of a point `off` from its expected position along x, `spread`: variance of the innovation along
/// each of two axes.
inline double density(double off, double spread) {
  return std::exp(-off * off / (2 * spread)) / (2 * std::numbers::pi * spread);
}

}  // namespace glint::test

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Eigen/Eigenvalues>

namespace glint {

/// The directions in which the components of a vector of N numbers are uncorrelated.
template <int N>
struct PrincipalAxes {
  Eigen::Matrix<double, N, 1> variance;   ///< along each, rising; below 0 by rounding alone
  Eigen::Matrix<double, N, N> direction;  ///< one a column, of length 1
};

/// Of a covariance, which may be singular. The library has that of two numbers, since the solver
/// takes seconds to compile.
template <int N>
PrincipalAxes<N> principal_axes(const Eigen::Matrix<double, N, N>& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> solver(covariance);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

extern template PrincipalAxes<2> principal_axes<2>(const Eigen::Matrix2d& covariance);

}  // namespace glint

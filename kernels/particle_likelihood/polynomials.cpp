// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/particle_likelihood/polynomials.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace glint {
namespace {

using Terms = std::array<double, kMaxTerms>;

/// Coefficients of the polynomial in z that has the given values at the first n nodes: Newton's
/// divided differences, then expanded.
Terms interpolate(const Terms& nodes, Terms values, int n) {
  for (int level = 1; level < n; ++level) {
    for (int j = n - 1; j >= level; --j) {
      values[j] = (values[j] - values[j - 1]) / (nodes[j] - nodes[j - level]);
    }
  }
  Terms monomials{};
  for (int j = n - 1; j >= 0; --j) {
    for (int d = n - 1; d > 0; --d) monomials[d] = monomials[d - 1] - nodes[j] * monomials[d];
    monomials[0] = values[j] - nodes[j] * monomials[0];
  }
  return monomials;
}

/// Terms that keep the error of every weight below 1e-6; a narrow spread turns more sharply.
int terms_for(double sigma) {
  if (sigma >= 0.45) return kFewTerms;
  return sigma >= 0.2 ? kMaxTerms : 0;
}

}  // namespace

WeightPolynomials fit_weights(const PointSpread& spread, int terms) {
  WeightPolynomials out;
  out.terms = terms;
  out.scale = static_cast<float>(1 / (spread.sigma * std::numbers::sqrt2));
  const int chebyshev = 2 * terms - 1;
  Terms offsets{}, squares{};
  for (int j = 0; j < terms; ++j) {
    offsets[j] = j + 1 < terms ? 0.5 * std::cos(std::numbers::pi * (j + 0.5) / chebyshev) : 0;
    squares[j] = offsets[j] * offsets[j];
  }
  for (int k = 0; k <= spread.half_width; ++k) {
    Terms even{}, odd{};
    for (int j = 0; j < terms; ++j) {
      const double near = spread.weight(k, offsets[j]), far = spread.weight(k, -offsets[j]);
      even[j] = (near + far) / 2;
      if (j + 1 < terms) odd[j] = (near - far) / (2 * offsets[j]);
    }
    even = interpolate(squares, even, terms);
    odd = interpolate(squares, odd, terms - 1);
    for (int d = 0; d < terms; ++d) {
      out.even[k][d] = static_cast<float>(even[d]);
      if (d + 1 < terms) out.odd[k][d] = static_cast<float>(odd[d]);
    }
  }
  return out;
}

WeightPolynomials fit_weights(const PointSpread& spread) {
  const int terms = terms_for(spread.sigma);
  if (terms > 0) return fit_weights(spread, terms);
  WeightPolynomials none;
  none.scale = static_cast<float>(1 / (spread.sigma * std::numbers::sqrt2));
  return none;
}

}  // namespace glint

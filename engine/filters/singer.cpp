// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/filters/singer.hpp"

#include <array>
#include <cmath>

namespace glint {
namespace {

// With b = fading * step, what one unit of acceleration at the begin of a step comes to at its end
// is position step^2 f_2, velocity step f_1 and acceleration f_0, where
//   f_p(b) = sum_n (-b)^n / (n + p)!
// and the covariance of what white noise makes of them,
//   Q_pq = step^(p+q+1) sum_nm (-b)^(n+m) / ((n + p)! (m + q)! (n + m + p + q + 1)).
// The closed forms lose ever more digits below b = 1: 13 % at 1e-3, all of them at 1e-5.
constexpr double kSeriesBelow = 0.5;
constexpr int kTerms = 20;

using Series = std::array<double, kTerms>;

constexpr double factorial(int n) {
  double product = 1;
  for (int i = 2; i <= n; ++i) product *= i;
  return product;
}

constexpr Series impulse(int p) {
  Series c{};
  for (int n = 0; n < kTerms; ++n) c[static_cast<std::size_t>(n)] = 1 / factorial(n + p);
  return c;
}

constexpr Series noise(int p, int q) {
  Series c{};
  for (int k = 0; k < kTerms; ++k) {
    double& sum = c[static_cast<std::size_t>(k)];
    for (int n = 0; n <= k; ++n) {
      sum += 1 / (factorial(n + p) * factorial(k - n + q) * (k + p + q + 1));
    }
  }
  return c;
}

double at(double b, const Series& coefficients) {
  double sum = 0;
  for (std::size_t k = kTerms; k-- > 0;) sum = coefficients[k] - b * sum;
  return sum;
}

}  // namespace

Eigen::Matrix3d transition(const Singer& model, double step) {
  static constexpr Series kVelocity = impulse(1), kPosition = impulse(2);
  const double b = model.fading * step, e = std::exp(-b);
  const bool small = b < kSeriesBelow;
  const double position = small ? at(b, kPosition) : (b - 1 + e) / (b * b);
  const double velocity = small ? at(b, kVelocity) : (1 - e) / b;
  return (Eigen::Matrix3d() << 1, step, step * step * position,  //
          0, 1, step * velocity,                                 //
          0, 0, e)
      .finished();
}

Eigen::Matrix3d process_noise(const Singer& model, double step) {
  static constexpr Series kPp = noise(2, 2), kPv = noise(2, 1), kPa = noise(2, 0),
                          kVv = noise(1, 1), kVa = noise(1, 0), kAa = noise(0, 0);
  const double b = model.fading * step, b2 = b * b, b3 = b2 * b;
  double pp, pv, pa, vv, va, aa;
  if (b < kSeriesBelow) {
    pp = at(b, kPp), pv = at(b, kPv), pa = at(b, kPa);
    vv = at(b, kVv), va = at(b, kVa), aa = at(b, kAa);
  } else {  // Singer 1970, each over 2 b^(p + q + 1)
    const double e = std::exp(-b), ee = e * e;
    pp = (1 - ee + 2 * b + 2 * b3 / 3 - 2 * b2 - 4 * b * e) / (2 * b3 * b2);
    pv = (ee + 1 - 2 * e + 2 * b * e - 2 * b + b2) / (2 * b2 * b2);
    pa = (1 - ee - 2 * b * e) / (2 * b3);
    vv = (4 * e - 3 - ee + 2 * b) / (2 * b3);
    va = (ee + 1 - 2 * e) / (2 * b2);
    aa = (1 - ee) / (2 * b);
  }
  const double t = step, t2 = t * t, t3 = t2 * t;
  return 2 * model.fading * model.variance *
         (Eigen::Matrix3d() << t3 * t2 * pp, t2 * t2 * pv, t3 * pa,  //
          t2 * t2 * pv, t3 * vv, t2 * va,                            //
          t3 * pa, t2 * va, t * aa)
             .finished();
}

}  // namespace glint

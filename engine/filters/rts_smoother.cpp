// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/filters/rts_smoother.hpp"

#include <cmath>
#include <stdexcept>

#include <Eigen/LU>

namespace glint {
namespace {

Eigen::Matrix2d transition(double step) {
  Eigen::Matrix2d f;
  f << 1, step, 0, 1;
  return f;
}

Eigen::Matrix2d symmetric(const Eigen::Matrix2d& m) { return (m + m.transpose()) / 2; }

AxisBelief predict(const AxisBelief& from, const AxisScan& scan) {
  const Eigen::Matrix2d f = transition(scan.step);
  const Eigen::Matrix2d p =
      f * from.covariance * f.transpose() + scan.process_noise * constant_velocity_noise(scan.step);
  return {f * from.mean, symmetric(p)};
}

AxisBelief update(const AxisBelief& predicted, const AxisScan& scan) {
  if (!std::isfinite(scan.variance)) return predicted;
  const double innovation_variance = predicted.covariance(0, 0) + scan.variance;
  if (!(innovation_variance > 0)) return predicted;  // both exact: nothing to weigh
  const Eigen::Vector2d gain = predicted.covariance.col(0) / innovation_variance;
  const Eigen::Matrix2d p = predicted.covariance - gain * predicted.covariance.row(0);
  return {predicted.mean + gain * (scan.position - predicted.mean(0)), symmetric(p)};
}

}  // namespace

Eigen::Matrix2d constant_velocity_noise(double step) {
  Eigen::Matrix2d q;
  q << step * step * step / 3, step * step / 2, step * step / 2, step;
  return q;
}

void smooth_constant_velocity(const AxisBelief& prior, std::span<const AxisScan> scans,
                              std::span<AxisBelief> smoothed) {
  if (smoothed.size() != scans.size() + 1) {
    throw std::invalid_argument("smoothing needs one belief more than scans");
  }
  smoothed[0] = prior;
  for (std::size_t t = 0; t < scans.size(); ++t) {  // P-HPMHT (15)
    smoothed[t + 1] = update(predict(smoothed[t], scans[t]), scans[t]);
  }
  for (std::size_t t = scans.size(); t-- > 0;) {  // P-HPMHT (16)
    const AxisBelief filtered = smoothed[t], predicted = predict(filtered, scans[t]);
    if (!(predicted.covariance.determinant() > 0)) continue;  // nothing flows back
    const Eigen::Matrix2d gain = filtered.covariance * transition(scans[t].step).transpose() *
                                 predicted.covariance.inverse();
    const AxisBelief& later = smoothed[t + 1];
    smoothed[t].mean = filtered.mean + gain * (later.mean - predicted.mean);
    smoothed[t].covariance = symmetric(
        filtered.covariance + gain * (later.covariance - predicted.covariance) * gain.transpose());
  }
}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/h_pmht/rts_smoother.hpp"

#include <cmath>
#include <stdexcept>

namespace glint {
namespace {

Eigen::Matrix2d symmetric(double position, double cross, double velocity) {
  Eigen::Matrix2d m;
  m << position, cross, cross, velocity;
  return m;
}

// F P F' + Q, with F = [1 step; 0 1] multiplied out: this runs for every target, scan and
// iteration.
AxisBelief predict(const AxisBelief& from, const AxisScan& scan) {
  const Eigen::Matrix2d &p = from.covariance, q = constant_velocity_noise(scan.step);
  const double cross = p(0, 1) + scan.step * p(1, 1);
  return {{from.mean(0) + scan.step * from.mean(1), from.mean(1)},
          symmetric(p(0, 0) + scan.step * (p(0, 1) + cross) + scan.process_noise * q(0, 0),
                    cross + scan.process_noise * q(0, 1), p(1, 1) + scan.process_noise * q(1, 1))};
}

AxisBelief update(const AxisBelief& predicted, const AxisScan& scan) {
  if (!std::isfinite(scan.variance)) return predicted;
  const Eigen::Matrix2d& p = predicted.covariance;
  const double innovation_variance = p(0, 0) + scan.variance;
  if (!(innovation_variance > 0)) return predicted;  // both exact: nothing to weigh
  const Eigen::Vector2d gain = p.col(0) / innovation_variance;
  return {predicted.mean + gain * (scan.position - predicted.mean(0)),
          symmetric(p(0, 0) - gain(0) * p(0, 0), p(0, 1) - gain(0) * p(0, 1),
                    p(1, 1) - gain(1) * p(0, 1))};
}

// What `later`, the state of the scan, says of the one before, which was `filtered`.
AxisBelief smooth(const AxisBelief& filtered, const AxisScan& scan, const AxisBelief& later) {
  const AxisBelief predicted = predict(filtered, scan);
  const Eigen::Matrix2d &p = filtered.covariance, &next = predicted.covariance;
  const double determinant = next(0, 0) * next(1, 1) - next(0, 1) * next(0, 1);
  if (!(determinant > 0)) return filtered;  // nothing flows back
  const double scale = 1 / determinant;
  // P F' P_next^-1
  const double p0 = p(0, 0) + scan.step * p(0, 1), p1 = p(0, 1) + scan.step * p(1, 1);
  const double g00 = (p0 * next(1, 1) - p(0, 1) * next(0, 1)) * scale;
  const double g01 = (p(0, 1) * next(0, 0) - p0 * next(0, 1)) * scale;
  const double g10 = (p1 * next(1, 1) - p(1, 1) * next(0, 1)) * scale;
  const double g11 = (p(1, 1) * next(0, 0) - p1 * next(0, 1)) * scale;
  const Eigen::Vector2d off = later.mean - predicted.mean;
  const Eigen::Matrix2d d = later.covariance - next;
  const double a = g00 * d(0, 0) + g01 * d(0, 1), b = g00 * d(0, 1) + g01 * d(1, 1);
  const double c = g10 * d(0, 0) + g11 * d(0, 1), e = g10 * d(0, 1) + g11 * d(1, 1);
  return {{filtered.mean(0) + g00 * off(0) + g01 * off(1),
           filtered.mean(1) + g10 * off(0) + g11 * off(1)},
          symmetric(p(0, 0) + a * g00 + b * g01, p(0, 1) + a * g10 + b * g11,
                    p(1, 1) + c * g10 + e * g11)};
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
    smoothed[t] = smooth(smoothed[t], scans[t], smoothed[t + 1]);
  }
}

}  // namespace glint

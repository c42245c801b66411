// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <vector>

#include "glint/bench/baselines/plain_imm.hpp"
#include "glint/bench/baselines/plain_pmht_weights.hpp"

namespace glint::bench {

/// The tracker `pmht-imm` and its kin for known targets, as P-PMHT reads: weights of all points for
/// all targets in one matrix, and a full Kalman update of every model at every iteration.
class PlainPmht {
 public:
  explicit PlainPmht(const PmhtConfig& config) : config_(config) {}
  /// A target at (x, y) [px] with velocity (vx, vy) [px/frame] one frame before the first scan.
  void start(double x, double y, double vx, double vy);
  void step(std::span<const PointMeasurement> points);
  std::vector<Eigen::Vector4d> states() const;  ///< [x vx y vy], in the order of start()

 private:
  struct Target {
    PlainBank bank;                        ///< predicted
    std::vector<PlainGaussian> estimates;  ///< by model, in the iteration at hand
    std::vector<Eigen::Vector3d> first;    ///< by model: the first centroid
  };
  PlainWeights predict(std::span<const PointMeasurement> points);
  double iterate(PlainWeights& weights, bool first);
  PlainGaussian maximise(const PlainGaussian& predicted, const Eigen::Vector3d& centroid) const;
  void take_in(Target& target) const;

  PmhtConfig config_;
  std::vector<Target> targets_;
};

}  // namespace glint::bench

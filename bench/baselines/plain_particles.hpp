// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <random>
#include <span>
#include <vector>

#include "glint/bench/baselines/plain_imm.hpp"
#include "glint/bench/baselines/plain_pmht_weights.hpp"
#include "glint/engine/trackers/pmht/mmpf_pmht.hpp"

namespace glint::bench {

/// The tracker `mmpf-pmht` for known targets: PMHT's weights in one matrix, every particle a vector
/// of doubles, normals of the standard library one after another, residual resampling by draws.
class PlainParticles {
 public:
  PlainParticles(const MmpfPmhtConfig& config, std::uint32_t seed)
      : config_(config), random_(seed) {}
  /// A target at (x, y) [px] with velocity (vx, vy) [px/frame] one frame before the first scan.
  void start(double x, double y, double vx, double vy);
  void step(std::span<const PointMeasurement> points);
  std::vector<Eigen::Vector4d> states() const;  ///< [x vx y vy], in the order of start()

 private:
  using Cloud = std::vector<Eigen::VectorXd>;
  struct Target {
    PlainBank bank;             ///< its beliefs are the clouds' moments
    std::vector<Cloud> clouds;  ///< by model
    std::vector<bool> collapsed;
    std::vector<Eigen::Vector3d> first, last;  ///< centroids by model
  };
  Cloud draw(const PlainGaussian& belief);
  Eigen::VectorXd noise(const Eigen::MatrixXd& root);
  void move(Target& target);
  PlainWeights predict(std::span<const PointMeasurement> points);
  double iterate(PlainWeights& weights, bool first);
  /// Weights of a cloud, the nearest particle's 1, and its squared distance over the variance.
  std::pair<std::vector<double>, double> weigh(const Cloud& cloud, const Eigen::Vector3d& at) const;
  void take_in(Target& target);
  Cloud resample(const Cloud& cloud, const std::vector<double>& weights);

  MmpfPmhtConfig config_;
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
  std::vector<Target> targets_;
};

}  // namespace glint::bench

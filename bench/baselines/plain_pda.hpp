// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <vector>

#include "glint/bench/baselines/plain_imm.hpp"
#include "glint/engine/trackers/imm_pda_ai/imm_pda_ai.hpp"

namespace glint::bench {

/// The tracker `imm-pda-ai` on points for known targets, each by itself: every point is measured
/// against every model of every target.
class PlainPda {
 public:
  explicit PlainPda(const ImmPdaAiConfig& config) : config_(config) {}
  /// A target at (x, y) [px] with velocity (vx, vy) [px/frame] and amplitude [sigma] one frame
  /// before the first scan.
  void start(double x, double y, double vx, double vy, double amplitude);
  void step(std::span<const PointMeasurement> points);
  std::vector<Eigen::Vector4d> states() const;  ///< [x vx y vy], in the order of start()

 private:
  struct Target {
    PlainBank bank;
    TargetAmplitude amplitude;
  };
  void update(Target& target, const std::vector<PointMeasurement>& gated, double threshold) const;

  ImmPdaAiConfig config_;
  std::vector<Target> targets_;
};

}  // namespace glint::bench

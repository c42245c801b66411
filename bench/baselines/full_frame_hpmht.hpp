// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "glint/engine/trackers/h_pmht/h_pmht.hpp"
#include "glint/kernels/cell_integrals/cell_integrals.hpp"

/// H-PMHT as one writes it from the paper: every step over every cell of the frame, in double, with
/// the integrals of each cell anew. An iteration passes over a frame three times: total
/// probabilities (6)-(8), counts and centroids (9)-(11), and spreads about the new state (17)-(18).
namespace glint::bench {

/// One target's expectation step, P-HPMHT (6)-(11), (17), (18), z = max(pixel - threshold, 0):
/// the total probabilities of all cells first, then counts and moments, each cell's integrals from
/// its own erf and exp. `cells` holds one number a pixel.
TargetSums full_frame_cell_integrals(FrameView frame, double threshold,
                                     const HistogramTarget& target, double background,
                                     std::span<double> cells, MixtureSums& mixture);

/// The tracker `h-pmht` for one known target in whitened frames: the same batches, iterations and
/// corrections of the paper, so the same estimates.
class FullFrameHPmht {
 public:
  /// `initiate` must be off.
  explicit FullFrameHPmht(const HPmhtConfig& config) : config_(config) {}

  /// State (x, vx, y, vy) one frame before the first scan [px, px/frame].
  void start(const Eigen::Vector4d& state);
  void step(FrameView frame);
  /// After the last scan.
  const Eigen::Vector4d& state() const { return scans_.back().state; }
  /// How often a scan has gone through an iteration.
  int scan_iterations() const { return scan_iterations_; }

 private:
  struct Scan {
    FrameView frame;
    double weight = 0;  ///< shots that motion counts as
    Eigen::Vector4d state;
    double var_x = 1, var_y = 1, proportion = 0;
    TargetSums sums = {};
    MixtureSums mixture = {};
    HistogramTarget before = {};  ///< what the last expectation step saw

    HistogramTarget target() const {
      return {state(0), state(2), std::sqrt(var_x), std::sqrt(var_y), proportion};
    }
  };
  struct Belief {
    Eigen::Vector4d mean;
    Eigen::Matrix4d covariance;
  };

  void slide();
  double iterate();
  Belief predict(const Belief& from, const Scan& scan) const;
  Belief update(const Belief& predicted, const Scan& scan) const;
  double prior_share() const { return scans_[0].mixture.shown / scans_[0].weight; }
  Belief scaled_prior() const { return {prior_.mean, prior_.covariance * prior_share()}; }
  double maximise(Scan& scan, const Eigen::Vector4d& smoothed);
  void take_extent(Scan& scan);

  HPmhtConfig config_;
  Belief prior_;
  Scan first_;
  std::vector<Scan> scans_;
  std::vector<double> cells_;
  int scan_iterations_ = 0;
};

}  // namespace glint::bench

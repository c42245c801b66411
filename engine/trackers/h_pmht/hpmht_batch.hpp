// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <tuple>
#include <vector>

#include "glint/engine/trackers/h_pmht/h_pmht_config.hpp"
#include "glint/engine/trackers/h_pmht/rts_smoother.hpp"
#include "glint/kernels/cell_integrals/cell_integrals.hpp"
#include "glint/kernels/core/device.hpp"
#include "glint/kernels/core/frame.hpp"

namespace glint {

/// Most scans in a batch.
inline constexpr std::size_t kMaxBatch = 32;

/// One scan of a batch.
struct BatchScan {
  FrameView frame;  ///< not empty
  CellRule rule;    ///< what its pixels show
  CellTotal total;  ///< of SumCells
  double step = 1;  ///< time since the scan before; for the first, since the priors [frames]

  // But for the view, which is that of a frame that somebody holds.
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.rule.threshold, s.rule.subtract, s.total, s.step);
  }
};

/// A target at a scan. Velocities are per frame.
struct BatchState {
  double x = 0, y = 0, vx = 0, vy = 0;
  double var_x = 1, var_y = 1;    ///< R, how far the target's intensity spreads [px^2]
  double proportion = 0;          ///< pi, its share of the scan's intensity
  double count = 0;               ///< n, the intensity that it explains
  double mean_x = 0, mean_y = 0;  ///< where that lies: synthetic measurement, P-HPMHT (11) [px]
  /// Of position and velocity along each axis, after smoothing.
  Eigen::Matrix2d covariance_x = Eigen::Matrix2d::Constant(NAN);
  Eigen::Matrix2d covariance_y = Eigen::Matrix2d::Constant(NAN);
  double existence = NAN;  ///< probability, of what is known up to this scan

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.x, s.y, s.vx, s.vy, s.var_x, s.var_y, s.proportion, s.count, s.mean_x,
                    s.mean_y, s.covariance_x, s.covariance_y, s.existence);
  }
};

/// A target over a batch. It exists from scan `first` on, which may be the one after the last;
/// earlier scans do not speak of it.
struct BatchTarget {
  std::size_t first = 0;
  AxisBelief prior_x, prior_y;                         ///< one step before scan `first`
  double noise = 1;                                    ///< spectral density of its acceleration, Q
  Eigen::Vector2d origin_x = Eigen::Vector2d::Zero();  ///< smoothed state at the priors' time
  Eigen::Vector2d origin_y = Eigen::Vector2d::Zero();
  std::array<BatchState, kMaxBatch> states;

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.first, s.prior_x, s.prior_y, s.noise, s.origin_x, s.origin_y, s.states);
  }
};

/// Expectation maximisation over a batch of scans and all targets at once, P-HPMHT section 3 with
/// the corrections of docs/trackers/h-pmht.md. Each iteration shares out the cells among the
/// targets and the background, smooths every target over its synthetic measurements, and takes
/// mixing proportions and extents anew. A common factor of all intensities changes nothing.
class HPmhtBatch {
 public:
  HPmhtBatch(const HPmhtConfig& config, const Device& device) : config_(config), device_(device) {}

  /// Improves the states from the values they hold, until no target moves by 1e-3 px or the
  /// iterations are used up; returns how many were used.
  int run(std::span<const BatchScan> scans, std::span<BatchTarget> targets);
  /// One iteration; returns the largest movement of a target [px].
  double iterate(std::span<const BatchScan> scans, std::span<BatchTarget> targets);
  /// Forgets the first scan: what a target knew then becomes its prior.
  void slide(std::span<const BatchScan> scans, std::span<BatchTarget> targets);
  /// What an iteration does not lower while Q is fixed and no target reaches over the border: log
  /// likelihood of the cells and log density of the motion, as often as it counts; up to a
  /// constant.
  double objective(std::span<const BatchScan> scans, std::span<const BatchTarget> targets);

  // slide() asks for what the last iteration found.
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.mixtures_);
  }

 private:
  void expect(std::span<const BatchScan> scans, std::span<const BatchTarget> targets,
              bool log_likelihood);
  void smooth(std::span<const BatchScan> scans, const BatchTarget& target, std::size_t count);
  double maximise(std::span<const BatchScan> scans, std::size_t k, BatchTarget& target);
  void take_noise(std::span<const BatchScan> scans, BatchTarget& target) const;
  double extent(double square, double centroid, double old_mean, double new_mean) const;
  void weigh(std::span<const BatchScan> scans);

  HPmhtConfig config_;
  Device device_;
  std::size_t targets_ = 0;
  std::vector<HistogramTarget> mixture_targets_;
  std::vector<TargetSums> sums_;  // by scan, then by target
  std::array<MixtureSums, kMaxBatch> mixtures_;
  std::array<double, kMaxBatch> counts_{};  // of targets and background, by scan
  IntegralsWorkspace workspace_;
  std::array<double, kMaxBatch> weight_{};  // shots that motion counts as, by scan
  std::array<AxisScan, kMaxBatch> scans_x_, scans_y_;
  std::array<AxisBelief, kMaxBatch + 1> beliefs_x_, beliefs_y_;
};

}  // namespace glint

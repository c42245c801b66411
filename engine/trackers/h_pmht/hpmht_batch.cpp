// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/h_pmht/hpmht_batch.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace glint {
namespace {

constexpr double kLeastProportion = 1e-9;
constexpr double kLeastMovement = 1e-3;  // [px]; below, the iterations end

/// e' Q^-1 e for a state that should have followed constant velocity in `step`, Q of unit density.
double surprise(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double step) {
  const Eigen::Vector2d off(to(0) - from(0) - step * from(1), to(1) - from(1));
  return off.dot(constant_velocity_noise(step).inverse() * off);
}

double distance(const AxisBelief& prior, const Eigen::Vector2d& state) {
  const Eigen::Vector2d off = state - prior.mean;
  return off.dot(prior.covariance.inverse() * off);
}

Eigen::Vector2d along_x(const BatchState& s) { return {s.x, s.vx}; }
Eigen::Vector2d along_y(const BatchState& s) { return {s.y, s.vy}; }

double background_proportion(std::span<const BatchTarget> targets, std::size_t t) {
  double rest = 1;
  for (const BatchTarget& target : targets) {
    if (target.first <= t) rest -= target.states[t].proportion;
  }
  return std::max(rest, kLeastProportion);
}

}  // namespace

// P-HPMHT (6)-(11), (17)
void HPmhtBatch::expect(std::span<const BatchScan> scans, std::span<const BatchTarget> targets,
                        bool log_likelihood) {
  targets_ = targets.size();
  sums_.resize(scans.size() * targets_);
  mixture_targets_.resize(targets_);
  for (std::size_t t = 0; t < scans.size(); ++t) {
    for (std::size_t k = 0; k < targets_; ++k) {
      const BatchState& s = targets[k].states[t];
      mixture_targets_[k] =
          targets[k].first <= t
              ? HistogramTarget{s.x, s.y, std::sqrt(s.var_x), std::sqrt(s.var_y), s.proportion}
              : HistogramTarget{NAN, NAN, 1, 1, 0};  // counts 0
    }
    CellIntegrals::Args args;
    args.frame = scans[t].frame, args.rule = scans[t].rule, args.total = scans[t].total;
    args.background = background_proportion(targets, t);
    args.targets = mixture_targets_;
    args.sums = std::span(sums_).subspan(t * targets_, targets_);
    args.mixture = &mixtures_[t];
    args.log_likelihood = log_likelihood;
    args.workspace = &workspace_;
    device_.run<CellIntegrals>(args);
    counts_[t] = mixtures_[t].background;
    for (const TargetSums& sums : args.sums) counts_[t] += sums.count;
  }
}

// A scan that shows nothing has no weight of its own; it gets the others' mean.
void HPmhtBatch::weigh(std::span<const BatchScan> scans) {
  double sum = 0;
  int count = 0;
  for (std::size_t t = 0; t < scans.size(); ++t) {
    const FrameView frame = scans[t].frame;
    const double cells = static_cast<double>(frame.width) * frame.height;
    weight_[t] = scans[t].total.norm * std::min(1.0, config_.sensor_area / cells);
    if (weight_[t] > 0) sum += weight_[t], ++count;
  }
  const double mean = count > 0 ? sum / count : 1;
  for (std::size_t t = 0; t < scans.size(); ++t) {
    if (!(weight_[t] > 0)) weight_[t] = mean;
  }
}

// Smooths the target over its first `count` scans.
void HPmhtBatch::smooth(std::span<const BatchScan> scans, const BatchTarget& target,
                        std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t t = target.first + i;
    const BatchState& s = target.states[t];
    const double noise = target.noise * mixtures_[t].shown / weight_[t];  // P-HPMHT (13), of Q_k
    scans_x_[i] = {scans[t].step, noise};
    scans_y_[i] = scans_x_[i];
    if (!(s.count > 0)) continue;
    scans_x_[i].position = s.mean_x, scans_x_[i].variance = s.var_x / s.count;  // P-HPMHT (12)
    scans_y_[i].position = s.mean_y, scans_y_[i].variance = s.var_y / s.count;
  }
  const double share = mixtures_[target.first].shown / weight_[target.first];
  smooth_constant_velocity({target.prior_x.mean, target.prior_x.covariance * share},
                           std::span(scans_x_).first(count),
                           std::span(beliefs_x_).first(count + 1));
  smooth_constant_velocity({target.prior_y.mean, target.prior_y.covariance * share},
                           std::span(scans_y_).first(count),
                           std::span(beliefs_y_).first(count + 1));
}

// P-HPMHT (17), (18): per axis, about the new state.
double HPmhtBatch::extent(double square, double centroid, double old_mean, double new_mean) const {
  const double shift = old_mean - new_mean;
  return std::clamp(square + shift * shift + 2 * (centroid - old_mean) * shift, config_.extent_low,
                    config_.extent_high);
}

double HPmhtBatch::maximise(std::span<const BatchScan> scans, std::size_t k, BatchTarget& target) {
  for (std::size_t t = target.first; t < scans.size(); ++t) {
    const TargetSums& measured = sums_[t * targets_ + k];
    BatchState& s = target.states[t];
    s.count = measured.count, s.mean_x = measured.x, s.mean_y = measured.y;
  }
  smooth(scans, target, scans.size() - target.first);
  target.origin_x = beliefs_x_[0].mean, target.origin_y = beliefs_y_[0].mean;
  double movement = 0;
  for (std::size_t t = target.first; t < scans.size(); ++t) {
    BatchState& s = target.states[t];
    const Eigen::Vector2d& x = beliefs_x_[t - target.first + 1].mean;
    const Eigen::Vector2d& y = beliefs_y_[t - target.first + 1].mean;
    movement = std::max({movement, std::abs(x(0) - s.x), std::abs(y(0) - s.y)});
    if (config_.estimate_extent && s.count > 0) {
      const TargetSums& measured = sums_[t * targets_ + k];
      s.var_x = extent(measured.xx, measured.x, s.x, x(0));
      s.var_y = extent(measured.yy, measured.y, s.y, y(0));
    }
    s.x = x(0), s.vx = x(1), s.y = y(0), s.vy = y(1);
    s.covariance_x = beliefs_x_[t - target.first + 1].covariance;
    s.covariance_y = beliefs_y_[t - target.first + 1].covariance;
    if (counts_[t] > 0) {  // P-HPMHT (14)
      s.proportion = std::max(s.count / counts_[t], kLeastProportion);
    }
  }
  return movement;
}

// P-HPMHT (19) for a Q that is known up to a factor: the matrix it prints has rank 2 a scan, and
// collapses or drifts.
void HPmhtBatch::take_noise(std::span<const BatchScan> scans, BatchTarget& target) const {
  double sum = 0, weights = 0;
  Eigen::Vector2d x = target.origin_x, y = target.origin_y;
  for (std::size_t t = target.first; t < scans.size(); ++t) {
    const BatchState& s = target.states[t];
    const double weight = weight_[t] / mixtures_[t].shown;
    sum +=
        weight * (surprise(x, along_x(s), scans[t].step) + surprise(y, along_y(s), scans[t].step));
    weights += weight;
    x = along_x(s), y = along_y(s);
  }
  constexpr double kDimensions = 4;
  if (!(weights > 0)) return;
  const double start = config_.process_noise;
  target.noise = std::clamp(sum / (kDimensions * weights), 0.1 * start, 10 * start);
}

double HPmhtBatch::iterate(std::span<const BatchScan> scans, std::span<BatchTarget> targets) {
  weigh(scans);
  expect(scans, targets, false);
  double movement = 0;
  for (std::size_t k = 0; k < targets.size(); ++k) {
    if (targets[k].first >= scans.size()) continue;
    movement = std::max(movement, maximise(scans, k, targets[k]));
    if (config_.estimate_process) take_noise(scans, targets[k]);
  }
  return movement;
}

int HPmhtBatch::run(std::span<const BatchScan> scans, std::span<BatchTarget> targets) {
  for (int used = 1; used <= config_.iterations; ++used) {
    if (iterate(scans, targets) < kLeastMovement) return used;
  }
  return config_.iterations;
}

void HPmhtBatch::slide(std::span<const BatchScan> scans, std::span<BatchTarget> targets) {
  weigh(scans);
  for (BatchTarget& target : targets) {
    if (target.first == 0) {
      smooth(scans, target, 1);
      const double share = mixtures_[0].shown / weight_[0];
      target.prior_x = {beliefs_x_[1].mean, beliefs_x_[1].covariance / share};
      target.prior_y = {beliefs_y_[1].mean, beliefs_y_[1].covariance / share};
    } else {
      --target.first;
    }
    std::shift_left(target.states.begin(), target.states.end(), 1);
  }
}

double HPmhtBatch::objective(std::span<const BatchScan> scans,
                             std::span<const BatchTarget> targets) {
  weigh(scans);
  expect(scans, targets, true);
  double sum = 0;
  for (std::size_t t = 0; t < scans.size(); ++t) sum += mixtures_[t].log_likelihood;
  for (const BatchTarget& target : targets) {
    if (target.first >= scans.size()) continue;
    sum -= weight_[target.first] / 2 *
           (distance(target.prior_x, target.origin_x) + distance(target.prior_y, target.origin_y));
    Eigen::Vector2d x = target.origin_x, y = target.origin_y;
    for (std::size_t t = target.first; t < scans.size(); ++t) {
      const BatchState& s = target.states[t];
      sum -= weight_[t] / (2 * target.noise) *
             (surprise(x, along_x(s), scans[t].step) + surprise(y, along_y(s), scans[t].step));
      x = along_x(s), y = along_y(s);
    }
  }
  return sum;
}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/peaks.hpp"

#include <algorithm>
#include <cmath>

#include "glint/kernels/core/cells.hpp"

namespace glint {
namespace {

constexpr int kMeanShifts = 3;

/// A cloud that descends from a few particles is narrower than its target is known. More on the
/// diagonal keeps the matrix positive definite.
StateCovariance with_floors(StateCovariance c) {
  constexpr double kPosition = 0.05, kVelocity = 0.02;  // [px], [px/frame]
  for (double* v : {&c.var_x, &c.var_y}) *v = std::max(*v, kPosition * kPosition);
  for (double* v : {&c.var_vx, &c.var_vy}) *v = std::max(*v, kVelocity * kVelocity);
  return c;
}

}  // namespace

TrackPoint point_of(const Peak& estimate, std::size_t modes, const StepTime& at) {
  TrackPoint point;
  point.frame = at.frame, point.time = at.time;
  point.x = estimate.x, point.y = estimate.y;
  point.vx = estimate.vx * at.velocity_scale, point.vy = estimate.vy * at.velocity_scale;
  point.intensity = estimate.intensity;
  point.set_covariance(with_floors(estimate).with_velocity_scaled(at.velocity_scale));
  for (std::size_t m = 0; m < modes; ++m) {
    point.mode_probability.push_back(estimate.mode_probability[m]);  // P-PHD (35)
  }
  return point;
}

Peak describe_cluster(const Particles& p, std::span<const std::uint32_t> members,
                      std::span<const float> weight) {
  Peak peak;
  peak.mode_probability.resize(kMostModes);
  for (const auto i : members) {
    const double w = weight[i];
    peak.mass += w;
    peak.x += w * p.x[i], peak.y += w * p.y[i];
    peak.vx += w * p.vx[i], peak.vy += w * p.vy[i];
    peak.intensity += w * p.intensity[i];
    peak.mode_probability[p.mode[i]] += w;
  }
  for (auto* v : {&peak.x, &peak.y, &peak.vx, &peak.vy, &peak.intensity}) *v /= peak.mass;
  for (auto& m : peak.mode_probability) m /= peak.mass;
  StateCovariance c = StateCovariance::zero();
  for (const auto i : members) {
    const double w = weight[i] / peak.mass;
    const double x = p.x[i] - peak.x, y = p.y[i] - peak.y;
    const double vx = p.vx[i] - peak.vx, vy = p.vy[i] - peak.vy;
    c.var_x += w * x * x, c.cov_xy += w * x * y, c.var_y += w * y * y;
    c.cov_x_vx += w * x * vx, c.cov_x_vy += w * x * vy;
    c.cov_y_vx += w * y * vx, c.cov_y_vy += w * y * vy;
    c.var_vx += w * vx * vx, c.cov_vx_vy += w * vx * vy, c.var_vy += w * vy * vy;
  }
  static_cast<StateCovariance&>(peak) = c;
  return peak;
}

template <class F>
void PeakFinder::for_runs_in(const CellRuns& runs, double x0, double y0, double x1, double y1,
                             F&& f) const {
  const int left = std::max(0, static_cast<int>(std::floor(x0 + 0.5)));
  const int right = std::min(width_ - 1, static_cast<int>(std::floor(x1 + 0.5)));
  const int top = std::max(0, static_cast<int>(std::floor(y0 + 0.5)));
  const int bottom = std::min(height_ - 1, static_cast<int>(std::floor(y1 + 0.5)));
  for (int y = top; y <= bottom && left <= right; ++y) {
    const auto first = cell_at(left, y, width_);
    const auto last = cell_at(right, y, width_);
    auto it = std::lower_bound(runs.cell.begin(), runs.cell.end(), first);
    for (; it != runs.cell.end() && *it <= last; ++it) {
      f(static_cast<std::uint32_t>(it - runs.cell.begin()));
    }
  }
}

double PeakFinder::box_mass(const CellRuns& runs, std::uint32_t run, int half_width) const {
  const auto [x, y] = pixel_at(runs.cell[run], width_);
  double mass = 0;
  for_runs_in(runs, x - half_width, y - half_width, x + half_width, y + half_width,
              [&](std::uint32_t r) { mass += mass_[r]; });
  return mass;
}

void PeakFinder::collect(const Particles& p, const CellRuns& runs, double x, double y,
                         double radius) {
  for_runs_in(runs, x - radius, y - radius, x + radius, y + radius, [&](std::uint32_t r) {
    for (std::uint32_t k = runs.first[r]; k < runs.first[r + 1]; ++k) {
      const auto i = runs.order[k];
      const bool inside = std::abs(p.x[i] - x) <= radius && std::abs(p.y[i] - y) <= radius;
      if (inside && weight_[i] > 0) members_.push_back(i);
    }
  });
}

bool PeakFinder::take(const Particles& p, const CellRuns& runs, std::uint32_t run,
                      const PeakConfig& config) {
  const Pixel cell = pixel_at(runs.cell[run], width_);
  Peak peak;
  peak.x = cell.x, peak.y = cell.y;
  const std::size_t first = members_.size();
  for (int shift = 0; shift <= kMeanShifts; ++shift) {
    members_.resize(first);
    collect(p, runs, peak.x, peak.y, config.radius);
    if (members_.size() == first) return false;
    peak = describe_cluster(p, std::span(members_).subspan(first), weight_);
  }
  peak.first = first, peak.last = members_.size();
  for (const auto i : members(peak)) weight_[i] = 0;
  for_runs_in(runs, peak.x - 2 * config.radius, peak.y - 2 * config.radius,
              peak.x + 2 * config.radius, peak.y + 2 * config.radius, [&](std::uint32_t r) {
                mass_[r] = 0;
                for (std::uint32_t k = runs.first[r]; k < runs.first[r + 1]; ++k) {
                  mass_[r] += weight_[runs.order[k]];
                }
              });
  if (peak.mass < config.threshold) {
    members_.resize(first);
    return false;
  }
  peaks_.push_back(peak);
  return true;
}

std::span<const Peak> PeakFinder::find(const Particles& particles, const CellRuns& runs, int width,
                                       int height, int half_width, const PeakConfig& config) {
  width_ = width, height_ = height;
  peaks_.clear(), members_.clear(), heap_.clear();
  mass_.assign(runs.mass.begin(), runs.mass.end());
  weight_.assign(particles.weight.begin(), particles.weight.end());
  members_.reserve(weight_.size()), heap_.reserve(runs.size());  // no peaks need more
  box_.resize(runs.size());
  box_sums(runs, width, height, half_width, mass_, box_);
  const auto threshold = static_cast<float>(config.threshold);
  for (std::uint32_t r = 0; r < runs.size(); ++r) {
    if (box_[r] >= threshold) heap_.push_back({box_[r], r});
  }
  std::make_heap(heap_.begin(), heap_.end());
  while (!heap_.empty()) {
    std::pop_heap(heap_.begin(), heap_.end());
    const Candidate best = heap_.back();
    heap_.pop_back();
    const auto now = static_cast<float>(box_mass(runs, best.run, half_width));
    if (now < threshold) continue;
    if (now < best.mass * (1 - 1e-5f)) {  // peaks found since have taken from this window
      heap_.push_back({now, best.run});
      std::push_heap(heap_.begin(), heap_.end());
      continue;
    }
    take(particles, runs, best.run, config);
  }
  return peaks_;
}

}  // namespace glint

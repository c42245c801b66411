// SPDX-License-Identifier: Apache-2.0
#include "glint/bench/baselines/full_frame_hpmht.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace glint::bench {
namespace {

constexpr double kMovement = 1e-3;  // [px]; iterations end when the target moves less

/// Integral of N over the cell around `pixel`. P-HPMHT (6), one axis
double cell_probability(double mean, double sigma, int pixel) {
  const double scale = 1 / (sigma * std::sqrt(2.0));
  return 0.5 * (std::erf((pixel + 0.5 - mean) * scale) - std::erf((pixel - 0.5 - mean) * scale));
}

struct CellMoments {
  double p, first, second;
};
/// Integrals of N, u N and u^2 N over the cell around `pixel`, u from the mean. P-HPMHT (10), (17)
CellMoments cell_moments(double mean, double sigma, int pixel) {
  const double a = pixel - 0.5 - mean, b = pixel + 0.5 - mean;
  const double peak = sigma / std::sqrt(2 * M_PI);
  const double at_a = peak * std::exp(-0.5 * a * a / (sigma * sigma));
  const double at_b = peak * std::exp(-0.5 * b * b / (sigma * sigma));
  const double p = cell_probability(mean, sigma, pixel);
  return {p, at_a - at_b, sigma * sigma * p + a * at_a - b * at_b};
}

double norm_of(FrameView frame, double threshold) {
  double sum = 0;
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) sum += std::max(frame(x, y) - threshold, 0.0);
  }
  return sum;
}

Eigen::Matrix4d transition() {
  Eigen::Matrix4d f = Eigen::Matrix4d::Identity();
  f(0, 1) = f(2, 3) = 1;
  return f;
}

}  // namespace

TargetSums full_frame_cell_integrals(FrameView frame, double threshold, const HistogramTarget& t,
                                     double background, std::span<double> cells,
                                     MixtureSums& mixture) {
  const double flat = background / (static_cast<double>(frame.width) * frame.height);
  mixture = {};
  std::size_t cell = 0;
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x, ++cell) {  // P-HPMHT (7), (8)
      cells[cell] = flat + t.proportion * cell_probability(t.x, t.sigma_x, x) *
                               cell_probability(t.y, t.sigma_y, y);
      mixture.shown += cells[cell];
    }
  }
  TargetSums s;
  cell = 0;
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x, ++cell) {  // P-HPMHT (9)-(11), (17), (18)
      const CellMoments px = cell_moments(t.x, t.sigma_x, x), py = cell_moments(t.y, t.sigma_y, y);
      const double share = std::max(frame(x, y) - threshold, 0.0) / cells[cell];
      const double weight = t.proportion * share;
      mixture.background += flat * share;
      s.count += weight * px.p * py.p;
      s.x += weight * px.first * py.p, s.y += weight * px.p * py.first;
      s.xx += weight * px.second * py.p, s.yy += weight * px.p * py.second;
      s.shown += px.p * py.p;
    }
  }
  s.x = t.x + s.x / s.count, s.y = t.y + s.y / s.count;
  s.xx /= s.count, s.yy /= s.count;
  return s;
}

void FullFrameHPmht::start(const Eigen::Vector4d& state) {
  prior_.mean = state;
  prior_.covariance = Eigen::Vector4d(config_.position_variance, config_.velocity_variance,
                                      config_.position_variance, config_.velocity_variance)
                          .asDiagonal();
  first_.state = state;
  first_.var_x = first_.var_y =
      config_.extent > 0 ? config_.extent : config_.psf_sigma * config_.psf_sigma + 0.25;
  first_.proportion = 0.5;  // P-HPMHT section 4
}

void FullFrameHPmht::step(FrameView frame) {
  if (scans_.size() == static_cast<std::size_t>(config_.batch)) slide();
  Scan scan = scans_.empty() ? first_ : scans_.back();
  scan.frame = frame;
  const double pixels = static_cast<double>(frame.width) * frame.height;
  scan.weight =
      norm_of(frame, config_.noise_threshold) * std::min(1.0, config_.sensor_area / pixels);
  scan.state = transition() * scan.state;
  scans_.push_back(scan);
  cells_.resize(static_cast<std::size_t>(pixels));
  for (int i = 0; i < config_.iterations; ++i) {
    scan_iterations_ += static_cast<int>(scans_.size());
    if (iterate() < kMovement) break;
  }
}

// What was known of the target at the oldest scan becomes its prior.
void FullFrameHPmht::slide() {
  const Belief first = update(predict(scaled_prior(), scans_[0]), scans_[0]);
  prior_ = {first.mean, first.covariance / prior_share()};
  scans_.erase(scans_.begin());
}

FullFrameHPmht::Belief FullFrameHPmht::predict(const Belief& from, const Scan& scan) const {
  const Eigen::Matrix4d f = transition();
  Eigen::Matrix4d q = Eigen::Matrix4d::Zero();  // P-HPMHT (22)
  q.topLeftCorner<2, 2>() << 1.0 / 3, 1.0 / 2, 1.0 / 2, 1;
  q.bottomRightCorner<2, 2>() = q.topLeftCorner<2, 2>();
  q *= config_.process_noise * scan.mixture.shown / scan.weight;  // P-HPMHT (13)
  return {f * from.mean, f * from.covariance * f.transpose() + q};
}

FullFrameHPmht::Belief FullFrameHPmht::update(const Belief& predicted, const Scan& scan) const {
  Eigen::Matrix<double, 2, 4> h = Eigen::Matrix<double, 2, 4>::Zero();
  h(0, 0) = h(1, 2) = 1;
  const Eigen::Matrix2d r =
      (Eigen::Vector2d(scan.var_x, scan.var_y) / scan.sums.count).asDiagonal();  // P-HPMHT (12)
  const Eigen::Matrix2d innovation = h * predicted.covariance * h.transpose() + r;
  const Eigen::Matrix<double, 4, 2> gain =
      predicted.covariance * h.transpose() * innovation.inverse();
  const Eigen::Vector2d measured(scan.sums.x, scan.sums.y);
  return {predicted.mean + gain * (measured - h * predicted.mean),
          predicted.covariance - gain * h * predicted.covariance};
}

double FullFrameHPmht::iterate() {
  for (Scan& s : scans_) {
    s.before = s.target();
    s.sums = full_frame_cell_integrals(s.frame, config_.noise_threshold, s.before, 1 - s.proportion,
                                       cells_, s.mixture);
  }
  std::vector<Belief> filtered{scaled_prior()};  // P-HPMHT (15)
  for (const Scan& s : scans_) filtered.push_back(update(predict(filtered.back(), s), s));
  Eigen::Vector4d later = filtered.back().mean;
  double movement = maximise(scans_.back(), later);
  for (std::size_t t = scans_.size() - 1; t-- > 0;) {  // P-HPMHT (16)
    const Belief &here = filtered[t + 1], next = predict(here, scans_[t + 1]);
    later = here.mean + here.covariance * transition().transpose() * next.covariance.inverse() *
                            (later - next.mean);
    movement = std::max(movement, maximise(scans_[t], later));
  }
  return movement;
}

// Takes the new state and the proportion, P-HPMHT (14); returns the movement.
double FullFrameHPmht::maximise(Scan& s, const Eigen::Vector4d& smoothed) {
  const Eigen::Vector4d moved = smoothed - s.state;
  s.state = smoothed;
  if (config_.estimate_extent) take_extent(s);
  s.proportion = s.sums.count / (s.sums.count + s.mixture.background);
  return std::max(std::abs(moved(0)), std::abs(moved(2)));
}

// P-HPMHT (17), (18): about the new state, so over all cells once more.
void FullFrameHPmht::take_extent(Scan& s) {
  const HistogramTarget& t = s.before;
  const double flat = (1 - t.proportion) / (static_cast<double>(s.frame.width) * s.frame.height);
  const auto about = [](const CellMoments& m, double shift) {
    return m.second - 2 * shift * m.first + shift * shift * m.p;
  };
  double xx = 0, yy = 0;
  for (int y = 0; y < s.frame.height; ++y) {
    for (int x = 0; x < s.frame.width; ++x) {
      const CellMoments px = cell_moments(t.x, t.sigma_x, x), py = cell_moments(t.y, t.sigma_y, y);
      const double weight = t.proportion * std::max(s.frame(x, y) - config_.noise_threshold, 0.0) /
                            (flat + t.proportion * px.p * py.p);
      xx += weight * about(px, s.state(0) - t.x) * py.p;
      yy += weight * about(py, s.state(2) - t.y) * px.p;
    }
  }
  s.var_x = std::clamp(xx / s.sums.count, config_.extent_low, config_.extent_high);
  s.var_y = std::clamp(yy / s.sums.count, config_.extent_low, config_.extent_high);
}

}  // namespace glint::bench

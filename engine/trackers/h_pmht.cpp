// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/h_pmht.hpp"

#include <algorithm>
#include <cmath>

#include "glint/engine/intensity_levels.hpp"
#include "glint/kernels/pixel_likelihood/pixel_likelihood.hpp"

namespace glint {
namespace {

double extent_of(const HPmhtConfig& config) {
  return config.extent > 0 ? config.extent : config.psf_sigma * config.psf_sigma + 0.25;
}

BatchConfig batch_config(const HPmhtConfig& config) {
  BatchConfig batch;
  batch.iterations = config.iterations;
  batch.estimate_extent = config.estimate_extent;
  batch.extent_low = config.extent_low, batch.extent_high = config.extent_high;
  batch.estimate_noise = config.estimate_process;
  batch.noise_low = 0.1 * config.process_noise, batch.noise_high = 10 * config.process_noise;
  batch.sensor_area = config.sensor_area;
  return batch;
}

double distance(const BatchState& a, const BatchState& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

}  // namespace

HPmht::HPmht(const HPmhtConfig& config, const Device& device, std::uint64_t /*seed*/)
    : config_(config),
      device_(device),
      spread_(PointSpread::of(config.psf_sigma)),
      batch_(batch_config(config), device) {
  if (std::max(config.confirm_frames, config.halt_frames) > config.batch) {
    throw ConfigError(
        "confirm_frames and halt_frames must not exceed batch: raise batch or lower "
        "them");
  }
  if (config.extent_low > config.extent_high) {
    throw ConfigError(
        "extent_low must not exceed extent_high: lower extent_low or raise "
        "extent_high");
  }
}

void HPmht::step(const Scan& scan, TrackLog& log) {
  const Frame& frame = config_.intensity == "rpim" ? scan.raw : scan.whitened;
  if (frame.view().empty()) return;
  advance(scan, frame);
  batch_.run(scans_, targets_);
  end_duplicates();
  judge();
  report(log);
  bury(log);
  add_starts(log);
  if (config_.initiate) add_candidates(scan);
}

// The window moves on by a scan, and every target with it.
void HPmht::advance(const Scan& scan, const Frame& frame) {
  if (window_.size() == static_cast<std::size_t>(config_.batch)) {
    batch_.slide(scans_, targets_);
    window_.erase(window_.begin());
    scans_.erase(scans_.begin());
  }
  BatchScan now;
  now.frame = frame.view();
  now.rule = rule_of(now.frame);
  device_.run<SumCells>({now.frame, now.rule, &now.total});
  double rate = 1;
  if (last_frame_ >= 0) {
    now.step = static_cast<double>(scan.frame - last_frame_);
    if (scan.time > last_time_) rate = now.step / (scan.time - last_time_);
  }
  for (BatchTarget& target : targets_) {
    BatchState& state = target.states[scans_.size()];
    state = last_state(target);
    state.x += now.step * state.vx, state.y += now.step * state.vy;
    state.count = 0;
  }
  window_.push_back({frame, scan.frame, scan.time, rate});
  scans_.push_back(now);
  last_frame_ = scan.frame, last_time_ = scan.time;
}

CellRule HPmht::rule_of(FrameView frame) {
  if (config_.intensity == "whitened") {
    return {.threshold = static_cast<float>(config_.noise_threshold), .subtract = true};
  }
  const double level =
      config_.threshold_scale * intensity_levels(frame, quantile_workspace_).displayed();
  return {.threshold = static_cast<float>(level), .subtract = config_.threshold == "subtract"};
}

BatchTarget HPmht::target_at(const Start& at, std::size_t first, double proportion) const {
  BatchTarget target;
  target.first = first;
  target.noise = config_.process_noise;
  target.prior_x.mean << at.x, at.vx;
  target.prior_y.mean << at.y, at.vy;
  target.prior_x.covariance =
      Eigen::Vector2d(config_.position_variance, config_.velocity_variance).asDiagonal();
  target.prior_y.covariance = target.prior_x.covariance;
  target.origin_x = target.prior_x.mean, target.origin_y = target.prior_y.mean;
  const double extent = extent_of(config_);
  target.states.fill({at.x, at.y, at.vx, at.vy, extent, extent, proportion});
  return target;
}

void HPmht::add_starts(TrackLog& log) {
  for (const Start& start : starts_) {
    const double proportion = 0.5 / static_cast<double>(starts_.size());  // P-HPMHT section 4
    targets_.push_back(target_at(start, scans_.size(), proportion));
    lives_.push_back({next_id_++});
    log.report(point_of(targets_.size() - 1, scans_.size() - 1));
  }
  starts_.clear();
}

void HPmht::add_candidates(const Scan& scan) {
  std::swap(points_before_, points_);
  find_points(scan.whitened.view());
  if (window_.size() < 2) return;  // the pair's first frame must be in the batch
  const double step = scans_.back().step;
  const double intensity = spread_.intensity_of_snr(config_.snr);
  const double proportion = std::min(0.5, intensity / std::max(scans_.back().total.norm, 1e-9));
  int left = config_.candidates_max;
  for (const PairStart& pair : pairs_.find(points_before_, points_, config_.speed_max * step)) {
    if (left == 0) break;
    if (crowded(pair.x, pair.y)) continue;
    const double vx = (pair.x - pair.before_x) / step, vy = (pair.y - pair.before_y) / step;
    const double lead = scans_[scans_.size() - 2].step;
    const Start at{pair.before_x - lead * vx, pair.before_y - lead * vy, vx, vy};
    BatchTarget& target = targets_.emplace_back(target_at(at, scans_.size() - 2, proportion));
    BatchState& before = target.states[scans_.size() - 2];
    BatchState& now = target.states[scans_.size() - 1];
    before.x = pair.before_x, before.y = pair.before_y;
    now.x = pair.x, now.y = pair.y;
    lives_.emplace_back();
    --left;
  }
}

void HPmht::find_points(FrameView whitened) {
  if (whitened.empty()) return points_.clear();
  if (ratio_.width() != whitened.width || ratio_.height() != whitened.height) {
    ratio_ = Image<float>(whitened.width, whitened.height);
  }
  PixelLikelihood::Args likelihood;
  likelihood.frame = whitened;
  likelihood.spread = spread_;
  likelihood.intensity = static_cast<float>(spread_.intensity_of_snr(config_.snr));
  likelihood.map = ratio_.view();
  device_.run<PixelLikelihood>(likelihood);
  FindPoints::Args maxima;
  maxima.map = ratio_.view();
  maxima.threshold = static_cast<float>(config_.candidate_ratio);
  maxima.points = &points_;
  maxima.workspace = &points_workspace_;
  device_.run<FindPoints>(maxima);
}

bool HPmht::crowded(double x, double y) const {
  return std::any_of(targets_.begin(), targets_.end(), [&](const BatchTarget& target) {
    const BatchState& s = last_state(target);
    const double radius = std::max(config_.separation, 2 * std::sqrt(std::max(s.var_x, s.var_y)));
    const double dx = s.x - x, dy = s.y - y;
    return dx * dx + dy * dy < radius * radius;
  });
}

// Two that cross are close for a moment; two that follow one target stay close.
bool HPmht::follow_one_target(std::size_t older, std::size_t younger) const {
  const BatchTarget &a = targets_[older], &b = targets_[younger];
  const BatchState& s = last_state(a);
  const double radius = std::max(config_.duplicate, std::sqrt(std::max(s.var_x, s.var_y)));
  if (distance(s, last_state(b)) >= radius) return false;
  if (lives_[older].id == 0 || lives_[younger].id == 0) return true;
  double sum = 0;
  int count = 0;
  for (std::size_t t = std::max(a.first, b.first); t < scans_.size(); ++t) {
    sum += distance(a.states[t], b.states[t]), ++count;
  }
  return sum < radius * count;
}

void HPmht::end_duplicates() {
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    for (std::size_t j = i + 1; j < targets_.size() && !lives_[i].over; ++j) {
      if (lives_[j].over || !follow_one_target(i, j)) continue;
      const bool older_is_less = lives_[i].id == 0 && lives_[j].id != 0;
      lives_[older_is_less ? i : j].over = true;
    }
  }
}

double HPmht::mean_count(const BatchTarget& target, int frames) const {
  double sum = 0;
  for (std::size_t t = scans_.size() - static_cast<std::size_t>(frames); t < scans_.size(); ++t) {
    sum += target.states[t].count;
  }
  return sum / frames;
}

void HPmht::judge() {
  for (std::size_t k = 0; k < targets_.size(); ++k) {
    const BatchTarget& target = targets_[k];
    Life& life = lives_[k];
    const int age = static_cast<int>(scans_.size() - target.first);
    if (life.over) continue;
    if (age >= config_.halt_frames &&
        mean_count(target, config_.halt_frames) < config_.halt_count) {
      life.over = true;
    } else if (life.id == 0 && age >= config_.confirm_frames &&
               mean_count(target, config_.confirm_frames) >= config_.confirm_count) {
      life.id = next_id_++;
    }
  }
}

TrackPoint HPmht::point_of(std::size_t k, std::size_t t) const {
  const BatchState& s = targets_[k].states[t];
  TrackPoint point;
  point.frame = window_[t].number, point.time = window_[t].time;
  point.track_id = lives_[k].id;
  point.status = TrackStatus::confirmed;
  point.x = s.x, point.y = s.y;
  point.vx = s.vx * window_[t].rate, point.vy = s.vy * window_[t].rate;
  point.intensity = s.count;
  return point;
}

void HPmht::report(TrackLog& log) {
  for (std::size_t k = 0; k < targets_.size(); ++k) {
    if (lives_[k].id == 0 || lives_[k].over) continue;
    for (std::size_t t = targets_[k].first; t + 1 < scans_.size(); ++t) log.revise(point_of(k, t));
    log.report(point_of(k, scans_.size() - 1));
  }
}

// What the batch believed of a track while its target was gone already is taken back.
void HPmht::bury(TrackLog& log) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < targets_.size(); ++k) {
    if (!lives_[k].over) {
      if (kept != k) targets_[kept] = targets_[k], lives_[kept] = lives_[k];
      ++kept;
      continue;
    }
    if (lives_[k].id == 0) continue;
    TrackPoint last = point_of(k, scans_.size() - 1);
    last.status = TrackStatus::halted;
    log.report(last);
    std::size_t gone = scans_.size();
    while (gone > targets_[k].first && targets_[k].states[gone - 1].count < config_.halt_count) {
      --gone;
    }
    if (gone < scans_.size()) log.drop(last.track_id, window_[gone].number);
  }
  targets_.resize(kept);
  lives_.resize(kept);
}

}  // namespace glint

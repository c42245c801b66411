// SPDX-License-Identifier: Apache-2.0
// How tracks of h-pmht are confirmed, how they end, and what is reported of them.
#include <algorithm>
#include <cmath>

#include "glint/engine/filters/bernoulli.hpp"
#include "glint/engine/trackers/h_pmht/h_pmht.hpp"
#include "glint/engine/trackers/h_pmht/point_evidence.hpp"

namespace glint {
namespace {

double distance(const BatchState& a, const BatchState& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

}  // namespace

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

void HPmht::update_lives() {
  for (std::size_t k = 0; k < targets_.size(); ++k) {
    const BatchTarget& target = targets_[k];
    Life& life = lives_[k];
    const int age = static_cast<int>(scans_.size() - target.first);
    if (life.over) continue;
    if (age >= config_.halt_frames &&
        mean_count(target, config_.halt_frames) < config_.halt_count) {
      life.over = true;
    } else if (life.id == 0 && age >= config_.confirm_frames &&
               mean_count(target, config_.confirm_frames) >= least_confirm_count(config_)) {
      life.id = next_id_++;
    }
  }
}

namespace {

StateCovariance covariance_of(const BatchState& s) {
  StateCovariance c = StateCovariance::zero();  // the axes are smoothed each by itself
  c.var_x = s.covariance_x(0, 0), c.cov_x_vx = s.covariance_x(0, 1);
  c.var_vx = s.covariance_x(1, 1);
  c.var_y = s.covariance_y(0, 0), c.cov_y_vy = s.covariance_y(0, 1);
  c.var_vy = s.covariance_y(1, 1);
  return c;
}

}  // namespace

TrackPoint HPmht::point_of(std::size_t k, std::size_t t) const {
  const BatchState& s = targets_[k].states[t];
  TrackPoint point;
  point.frame = window_[t].number, point.time = window_[t].time;
  point.track_id = lives_[k].id;
  point.status = TrackStatus::confirmed;
  point.x = s.x, point.y = s.y;
  point.vx = s.vx * window_[t].rate, point.vy = s.vy * window_[t].rate;
  point.intensity = s.count, point.existence = s.existence;
  // Counts stand for shots, so that their unit counts: only that of the noise says how many.
  if (config_.intensity == CellIntensity::whitened) {
    point.set_covariance(covariance_of(s).with_velocity_scaled(window_[t].rate));
  }
  return point;
}

// By the pixels around where the scans before say that it is; a Bernoulli filter's update. Frames
// as delivered have no known noise.
void HPmht::weigh_existence() {
  constexpr double kSurvival = 0.99;
  if (config_.intensity == CellIntensity::rpim) return;
  const std::size_t now = scans_.size() - 1;
  const double step = scans_[now].step;
  const double survival = std::pow(kSurvival, step);
  device_.workers().for_tiles(targets_.size(), [&](std::size_t k) {
    BatchTarget& target = targets_[k];
    BatchState& s = target.states[now];
    const Eigen::RowVector2d ahead(1, step);
    const double moved = constant_velocity_noise(step)(0, 0) * target.noise;
    const ExpectedPlace place{s.x, s.y, ahead * s.covariance_x * ahead.transpose() + moved,
                              ahead * s.covariance_y * ahead.transpose() + moved};
    s.existence = bernoulli_update(
        s.existence, survival,
        mean_likelihood_ratio(window_[now].frame.view(), PointSpread::of(config_.psf_sigma),
                              intensities_, place));
  });
}

void HPmht::report(TrackLog& log) {
  for (std::size_t k = 0; k < targets_.size(); ++k) {
    if (lives_[k].id == 0 || lives_[k].over) continue;
    for (std::size_t t = targets_[k].first; t + 1 < scans_.size(); ++t) log.revise(point_of(k, t));
    log.report(point_of(k, scans_.size() - 1));
  }
}

// What the batch believed of a track while its target was gone already is taken back.
void HPmht::remove_ended(TrackLog& log) {
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

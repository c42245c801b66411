// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/h_pmht/h_pmht.hpp"

#include <algorithm>
#include <cmath>

#include "glint/engine/frames/intensity_levels.hpp"
#include "glint/engine/tracks/tracker_state.hpp"

namespace glint {
namespace {

double extent_of(const HPmhtConfig& config) {
  return config.extent > 0 ? config.extent : config.psf_sigma * config.psf_sigma + 0.25;
}

double candidate_intensity(const HPmhtConfig& config) {
  return PointSpread::of(config.psf_sigma).intensity_of_snr(config.snr);
}

/// Equally spaced in decibels about that of `snr`.
std::vector<double> likely_intensities(const HPmhtConfig& config) {
  std::vector<double> intensities;
  for (const double off : {-6, -2, 2, 6}) {
    intensities.push_back(PointSpread::of(config.psf_sigma).intensity_of_snr(config.snr + off));
  }
  return intensities;
}

/// Existence of a candidate: births are rare, and there are many pairs of pixels to choose from. A
/// maximum stands for some pixels.
double candidate_existence(const FramePairStart& pair, FrameView frame, double reach) {
  constexpr double kBirths = 0.05, kPixels = 4;
  const double places =
      static_cast<double>(frame.width) * frame.height * (2 * reach + 1) * (2 * reach + 1);
  const double odds = kBirths / places * kPixels * kPixels * std::exp(std::min(pair.score, 50.0));
  return odds / (1 + odds);
}

}  // namespace

HPmht::HPmht(const HPmhtConfig& config, const Device& device, std::uint64_t /*seed*/)
    : config_(valid(config)),
      device_(device),
      intensities_(likely_intensities(config)),
      batch_(config, device),
      pairs_(PointSpread::of(config.psf_sigma), candidate_intensity(config), config.candidate_ratio,
             device) {
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

void HPmht::restored() {
  require_bytes(window_.size() <= static_cast<std::size_t>(config_.batch) &&
                    scans_.size() == window_.size() && lives_.size() == targets_.size() &&
                    (targets_.empty() || !scans_.empty()),
                "the batch is not whole");
  require_frame_number(last_frame_);
  for (std::size_t t = 0; t < scans_.size(); ++t) {
    require_bytes(bool{window_[t].frame}, "a frame of the batch is missing");
    scans_[t].frame = window_[t].frame.view();
  }
  for (const BatchTarget& target : targets_) {
    require_bytes(target.first <= scans_.size(), "a target of the batch has no such scan");
  }
}

void HPmht::step(const Scan& scan, TrackLog& log) {
  const Frame& frame = config_.intensity == CellIntensity::rpim ? scan.raw : scan.whitened;
  if (frame.width() == 0) return;
  advance(scan, frame);
  weigh_existence();
  batch_.run(scans_, targets_);
  end_duplicates();
  update_lives();
  report(log);
  remove_ended(log);
  take_cues(scan);
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
  now.frame = frame.for_kernels();
  now.rule = rule_of(frame);
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

CellRule HPmht::rule_of(const Frame& frame) {
  if (config_.intensity == CellIntensity::whitened) {
    return {.threshold = static_cast<float>(config_.noise_threshold), .subtract = true};
  }
  const double level =
      config_.threshold_scale * intensity_levels(frame.view(), quantile_workspace_).displayed();
  return {.threshold = static_cast<float>(level),
          .subtract = config_.threshold == CellThreshold::subtract};
}

BatchTarget HPmht::target_at(const Start& at, std::size_t first, double proportion) const {
  BatchTarget target;
  target.first = first;
  target.noise = config_.process_noise;
  target.prior_x.mean << at.x, at.vx;
  target.prior_y.mean << at.y, at.vy;
  const auto or_set = [](double told, double set) { return told > 0 ? told : set; };
  target.prior_x.covariance =
      Eigen::Vector2d(or_set(at.position_variance, config_.position_variance),
                      or_set(at.velocity_variance, config_.velocity_variance))
          .asDiagonal();
  target.prior_y.covariance = target.prior_x.covariance;
  target.origin_x = target.prior_x.mean, target.origin_y = target.prior_y.mean;
  const double extent = extent_of(config_);
  BatchState state{at.x, at.y, at.vx, at.vy, extent, extent, proportion};
  state.covariance_x = target.prior_x.covariance, state.covariance_y = target.prior_y.covariance;
  state.existence = 0.9;
  target.states.fill(state);
  return target;
}

// A candidate beside the new track ends in the next scan.
void HPmht::take_cues(const Scan& scan) {
  const double rate = window_.back().rate;
  for (const Cue& cue : scan.cues) {
    bool followed = false;
    for (std::size_t k = 0; k < targets_.size() && !followed; ++k) {
      const BatchState& s = last_state(targets_[k]);
      followed = lives_[k].id != 0 && std::hypot(s.x - cue.x, s.y - cue.y) < config_.separation;
    }
    const bool told = std::ranges::any_of(starts_, [&](const Start& start) {
      return std::hypot(start.x - cue.x, start.y - cue.y) < config_.separation;
    });
    if (followed || told) continue;
    const double sigma = cue.sigma_or(0), speed = config_.speed_max;
    starts_.push_back(cue.moves() ? Start{cue.x, cue.y, cue.vx / rate, cue.vy / rate, sigma * sigma}
                                  : Start{cue.x, cue.y, 0, 0, sigma * sigma, speed * speed / 3});
  }
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
  const double step = scans_.back().step;
  const auto pairs = pairs_.find(scan.whitened.for_kernels(), config_.speed_max * step);
  if (window_.size() < 2) return;  // the pair's first frame must be in the batch
  const double proportion =
      std::min(0.5, candidate_intensity(config_) / std::max(scans_.back().total.norm, 1e-9));
  int left = config_.candidates_max;
  for (const FramePairStart& pair : pairs) {
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
    before.existence = now.existence =
        candidate_existence(pair, scans_.back().frame, config_.speed_max * step);
    for (BatchState* s : {&before, &now}) {
      s->covariance_x = target.prior_x.covariance, s->covariance_y = target.prior_y.covariance;
    }
    lives_.emplace_back();
    --left;
  }
}

template class TrackerOf<HPmht>;

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/pmht.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "glint/engine/trackers/mmpf_pmht.hpp"

namespace glint {
namespace {

constexpr double kClaimed = 0.5;  // of a point: more is some track's
constexpr double kHit = 0.25;     // number of points of a track that was seen

KalmanBank bank_of(const PmhtConfig& config, const PmhtStart& start, std::uint64_t /*seed*/,
                   std::int64_t /*track*/) {
  return {pmht_bank(config, start), config.measurement_variance};
}

ParticleBank bank_of(const MmpfPmhtConfig& config, const PmhtStart& start, std::uint64_t seed,
                     std::int64_t track) {
  return {pmht_bank(config, start), config.particles, config.measurement_variance, seed, track};
}

Eigen::Vector2d position_of(const Gaussian<4>& state) { return {state.mean(0), state.mean(2)}; }

}  // namespace

void PmhtArea::see(const Scan& scan) {
  const FrameView frame = scan.raw ? scan.raw.view() : scan.whitened.view();
  frame_ = static_cast<double>(frame.width) * frame.height;
  if (frame_ > 0) return;
  for (const Point& p : scan.points) {
    if (std::isfinite(p.x) && std::isfinite(p.y)) box_.extend(Eigen::Vector2d(p.x, p.y));
  }
}

double PmhtArea::size(double margin) const {
  if (frame_ > 0) return frame_;
  if (box_.isEmpty()) return 1;
  const Eigen::Vector2d sides = box_.sizes() + Eigen::Vector2d::Constant(2 * margin);
  return std::max(sides.prod(), 1.0);
}

template <class Config, class Bank>
PmhtTracker<Config, Bank>::PmhtTracker(const Config& config, const Device&, std::uint64_t seed)
    : config_(config), seed_(seed) {
  settings_.origins.detection = config.detection;
  settings_.variance = config.measurement_variance;
  settings_.mixture = config.association == "mixture";
  settings_.iterations = config.iterations, settings_.tolerance = config.tolerance;
  if (config.life.confirm_hits > config.life.confirm_window) {
    throw ConfigError("confirm_hits must not exceed confirm_window: lower it or widen the window");
  }
}

/// The numbers are those of the steps in docs/trackers/pmht-imm.md. Tentative tracks get what the
/// confirmed ones leave.
template <class Config, class Bank>
void PmhtTracker<Config, Bank>::step(const Scan& scan, TrackLog& log) {
  if (!clock_.started()) log.set_mode_names(pmht_mode_names(config_));
  const StepTime at = clock_.tick(scan);
  elapsed_ = config_.clock == "frames" ? at.step : scan.time - std::exchange(last_time_, scan.time);
  take_points(scan);
  predict();            // 7
  associate(true, at);  // 2-6
  associate(false, at);
  end_duplicates();
  for (const PmhtStart& start : known_) add(start, TrackPoint::kUnknown, true, at);
  known_.clear();
  start_tracks(at);  // 1
  report(at, log);
  std::erase_if(tracks_, [](const Track& track) { return track.life.over(); });
}

template <class Config, class Bank>
void PmhtTracker<Config, Bank>::take_points(const Scan& scan) {
  points_.clear(), amplitudes_.clear();
  for (const Point& p : scan.points) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) continue;
    points_.emplace_back(p.x, p.y);
    amplitudes_.push_back(static_cast<double>(p.amplitude));
  }
  claimed_.assign(points_.size(), 0);
  area_.see(scan);
  const auto of_targets =
      std::ranges::count_if(tracks_, [](const Track& track) { return track.life.confirmed(); });
  const double false_points = static_cast<double>(points_.size()) - static_cast<double>(of_targets);
  settings_.origins.clutter = config_.clutter_density > 0
                                  ? config_.clutter_density
                                  : std::max(false_points, 1.0) / area_.size(config_.gate);
}

template <class Config, class Bank>
void PmhtTracker<Config, Bank>::predict() {
  expected_.clear();
  for (Track& track : tracks_) {
    track.bank.predict(elapsed_);
    track.state = track.bank.state();
    expected_.push_back({track.id, track.state.mean(0), track.state.mean(2)});
  }
}

/// Pairs the tracks, confirmed or not, with the points that are still to be had.
template <class Config, class Bank>
void PmhtTracker<Config, Bank>::gate(bool confirmed) {
  followers_.clear(), modes_.clear(), pairs_.clear();
  for (Track& track : tracks_) {
    if (track.life.confirmed() != confirmed) continue;
    const auto follower = static_cast<std::uint32_t>(followers_.size());
    pmht_gate(follower, position_of(track.state), config_.gate, points_, pairs_);
    for (std::size_t m = 0; m < track.bank.probability().size(); ++m) {
      modes_.push_back(track.bank.mode(m));
    }
    followers_.push_back(&track);
  }
  std::erase_if(pairs_, [&](const PmhtPair& pair) { return claimed_[pair.point] >= kClaimed; });
}

template <class Config, class Bank>
void PmhtTracker<Config, Bank>::associate(bool confirmed, const StepTime& at) {
  gate(confirmed);
  if (followers_.empty()) return;
  const std::size_t models = modes_.size() / followers_.size();
  em_.run(settings_, points_, pairs_, models, modes_,
          [&](std::size_t mode, const PmhtCentroid& centroid) -> Eigen::Vector2d {
            return followers_[mode / models]->bank.maximise(mode % models, centroid);
          });
  take_in(at);
}

template <class Config, class Bank>
void PmhtTracker<Config, Bank>::take_in(const StepTime& at) {
  const Eigen::Matrix2d noise = config_.measurement_variance * Eigen::Matrix2d::Identity();
  const double per_density = config_.detection / settings_.origins.clutter;
  const std::size_t models = modes_.size() / followers_.size();
  std::size_t k = 0;  // pairs are by follower
  for (std::size_t f = 0; f < followers_.size(); ++f) {
    Track& track = *followers_[f];
    const PositionPrediction<4> expected = predict_position(track.state, noise);
    track.weight = 0, track.ratio = 1 - config_.detection;
    double amplitude = 0;
    for (; k < pairs_.size() && pairs_[k].target == f; ++k) {
      const std::size_t j = pairs_[k].point;
      const double z = em_.posterior()[k];
      claimed_[j] += z, track.weight += z, amplitude += z * amplitudes_[j];
      track.ratio += per_density * std::exp(expected.log_density(points_[j]));
    }
    if (track.weight >= kHit)
      track.amplitude = amplitude / track.weight, track.last_seen = at.frame;
    track.life.see(config_.life, track.weight >= kHit, track.ratio, at.step);
    track.bank.update(em_.first().subspan(f * models, models),
                      em_.last().subspan(f * models, models));
    track.state = track.bank.state();
  }
}

template <class Config, class Bank>
void PmhtTracker<Config, Bank>::end_duplicates() {
  for (std::size_t b = 1; b < tracks_.size(); ++b) {
    Track& younger = tracks_[b];
    bool near = false;
    for (std::size_t a = 0; a < b && !near; ++a) {
      near =
          !tracks_[a].life.over() && tracks_[a].life.confirmed() &&
          (position_of(tracks_[a].state) - position_of(younger.state)).norm() < config_.separation;
    }
    younger.merged = near ? younger.merged + 1 : 0;
    const bool for_long = config_.merge_scans > 0 && younger.merged >= config_.merge_scans;
    if (near && (!younger.life.confirmed() || for_long)) younger.life.end();
  }
}

template <class Config, class Bank>
void PmhtTracker<Config, Bank>::add(const PmhtStart& start, double amplitude, bool known,
                                    const StepTime& at) {
  const std::int64_t id = next_id_++;
  Track track{id,
              at.frame,
              at.frame,
              bank_of(config_, start, seed_, id),
              TrackLife(config_.life, known),
              amplitude};
  track.state = track.bank.state();
  tracks_.push_back(std::move(track));
}

template <class Config, class Bank>
bool PmhtTracker<Config, Bank>::crowded(const Eigen::Vector2d& position) const {
  return std::ranges::any_of(tracks_, [&](const Track& track) {
    return !track.life.over() && (position_of(track.state) - position).norm() < config_.separation;
  });
}

template <class Config, class Bank>
void PmhtTracker<Config, Bank>::start_tracks(const StepTime& at) {
  if (!config_.initiate) return;
  std::swap(free_, free_before_);
  free_.clear();
  for (std::size_t j = 0; j < points_.size(); ++j) {
    if (claimed_[j] >= kClaimed || amplitudes_[j] < config_.start_amplitude) continue;
    free_.push_back({points_[j], std::isfinite(amplitudes_[j]) ? amplitudes_[j] : 0});
  }
  if (!(elapsed_ > 0)) return;
  for (const PointStart& pair : starts_.find(free_before_, free_, config_.speed_max * elapsed_)) {
    if (crowded(pair.now.position)) continue;
    add({pair.now.position, (pair.now.position - pair.before.position) / elapsed_, elapsed_},
        pair.now.amplitude, false, at);
  }
}

template <class Config, class Bank>
void PmhtTracker<Config, Bank>::report(const StepTime& at, TrackLog& log) {
  const double rate = config_.clock == "frames" ? at.velocity_scale : 1;
  for (Track& track : tracks_) {
    if (track.life.over() && !track.life.confirmed()) {
      log.drop(track.id, track.first_frame);
      continue;
    }
    TrackPoint point;
    point.frame = at.frame, point.time = at.time, point.track_id = track.id;
    point.status = track.life.status();
    const auto& x = track.state.mean;
    point.x = x(0), point.y = x(2), point.vx = x(1) * rate, point.vy = x(3) * rate;
    point.intensity = track.amplitude, point.existence = track.life.existence();
    const auto& p = track.state.covariance;
    point.var_x = p(0, 0), point.cov_xy = p(0, 2), point.var_y = p(2, 2);
    point.mode_probability = track.bank.probability();
    log.report(point);
    if (track.life.over()) log.drop(track.id, track.last_seen + 1);
    if (track.life.confirmed() && !std::exchange(track.told, true)) {
      log.confirm(track.id, track.first_frame);
    }
  }
}

template class PmhtTracker<PmhtConfig, KalmanBank>;
template class PmhtTracker<MmpfPmhtConfig, ParticleBank>;

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/imm_pda_ai/imm_pda_ai.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "glint/engine/trackers/imm_pda_ai/pda.hpp"
#include "glint/engine/tracks/tracker_state.hpp"

namespace glint {
namespace {

double variance_of(const ImmPdaAiConfig& config) {
  if (config.measurement_variance > 0) return config.measurement_variance;
  return config.points == "units" ? 16 : 1;  // P-HPMHT (21)
}

Eigen::Vector2d position_of(const Imm& imm) {
  const Gaussian<4> state = imm.combined();
  return {state.mean(0), state.mean(2)};
}

}  // namespace

ImmPdaAi::ImmPdaAi(const ImmPdaAiConfig& config, const Device& device, std::uint64_t /*seed*/)
    : config_(config),
      device_(device),
      noise_(variance_of(config) * Eigen::Matrix2d::Identity()),
      amplitude_model_(amplitude_model(config.amplitude)),
      miss_(1 - config.detection * (1 - std::exp(-config.gate / 2))) {
  if (config.confirm_hits > config.confirm_window) {
    throw ConfigError("confirm_hits must not exceed confirm_window: lower it or widen the window");
  }
}

void ImmPdaAi::step(const Scan& scan, TrackLog& log) {
  if (last_frame_ < 0) log.set_mode_names({"cv-slow", "cv-fast"});
  const double step = last_frame_ < 0 ? 1 : static_cast<double>(scan.frame - last_frame_);
  const double seconds = last_frame_ < 0 ? 0 : scan.time - last_time_;
  measure(scan);
  set_clutter(scan);
  for (Track& track : tracks_) {
    track.imm.mix();
    track.imm.predict(step);
    update(track, scan.frame);
  }
  end_duplicates();
  add_starts(scan);
  if (config_.initiate) start_from_free_points(scan);
  report(scan, seconds > 0 ? step / seconds : 1, log);
  std::erase_if(tracks_, [](const Track& track) { return track.over; });
  last_frame_ = scan.frame, last_time_ = scan.time;
}

/// Finds the points in the gate of any model.
void ImmPdaAi::associate(const Track& track) {
  gated_.assign(measurements_.size(), false);
  for (const AnyMode& any : track.imm.modes()) {
    std::visit(
        [&](const auto& mode) {
          const auto expected = predict_position(mode.belief, noise_);
          for (std::size_t i = 0; i < measurements_.size(); ++i) {
            if (expected.distance(measurements_[i].position) <= config_.gate) gated_[i] = true;
          }
        },
        any);
  }
  positions_.clear(), amplitudes_.clear();
  for (std::size_t i = 0; i < measurements_.size(); ++i) {
    if (!gated_[i]) continue;
    measurements_[i].free = false;
    positions_.push_back(measurements_[i].position);
    amplitudes_.push_back(measurements_[i].amplitude);
  }
}

void ImmPdaAi::update(Track& track, std::int64_t frame) {
  associate(track);
  const std::size_t points = positions_.size(), modes = track.imm.modes().size();
  log_ratio_.resize(points), beta_.resize(modes * (points + 1));
  std::array<double, kMostModes> log_likelihood{};
  for (std::size_t j = 0; j < modes; ++j) {
    const std::span beta(&beta_[j * (points + 1)], points + 1);
    std::visit(
        [&](auto& mode) {
          const auto expected = predict_position(mode.belief, noise_);
          for (std::size_t i = 0; i < points; ++i) {
            log_ratio_[i] =
                std::log(config_.detection / clutter_) + expected.log_density(positions_[i]) +
                track.amplitude.log_ratio(amplitude_model_, amplitudes_[i], amplitude_threshold_);
          }
          log_likelihood[j] = pda_weights(log_ratio_, miss_, beta);
          mode.belief = pda_update(mode.belief, expected, std::span(std::as_const(positions_)),
                                   std::span<const double>(beta));
        },
        track.imm.modes()[j]);
  }
  track.imm.weigh(std::span(log_likelihood).first(modes));
  track.position = position_of(track.imm);
  learn(track, points, frame);
}

/// The amplitude, and whether the target was seen.
void ImmPdaAi::learn(Track& track, std::size_t points, std::int64_t frame) const {
  double own = 0, amplitude = 0;
  for (std::size_t j = 0; j < track.imm.modes().size(); ++j) {
    for (std::size_t i = 0; i < points; ++i) {
      const double beta = track.imm.probability()[j] * beta_[j * (points + 1) + i + 1];
      own += beta, amplitude += beta * amplitudes_[i];
    }
  }
  if (own > 0) track.amplitude.learn(amplitude / own, own);
  const bool seen = own >= 0.5;
  if (seen) track.last_seen = frame;
  ++track.age, track.hits += seen, track.misses = seen ? 0 : track.misses + 1;
  if (track.confirmed) {
    track.over = track.misses >= config_.halt_misses;
  } else {
    track.confirmed = track.hits >= config_.confirm_hits;
    track.over = !track.confirmed && track.age >= config_.confirm_window;
  }
}

void ImmPdaAi::end_duplicates() {
  for (std::size_t b = 1; b < tracks_.size(); ++b) {
    for (std::size_t a = 0; a < b && !tracks_[b].over; ++a) {
      if (tracks_[a].over) continue;
      const double apart = (tracks_[a].position - tracks_[b].position).norm();
      if (apart >= config_.separation) continue;
      const bool younger_is_surer = tracks_[b].confirmed && !tracks_[a].confirmed;
      (younger_is_surer ? tracks_[a] : tracks_[b]).over = true;
    }
  }
}

void ImmPdaAi::restored() {
  require_frame_number(last_frame_);
  const Imm bank = bank_at({0, 0, 0, 0});
  for (const Track& track : tracks_) {
    require_frame_number(track.last_seen);
    require_bytes(track.imm.alike(bank), "a target moves by other models");
  }
}

Imm ImmPdaAi::bank_at(const Start& at) const {
  Mode<ConstantVelocity> slow{{config_.noise_slow}, {}};
  slow.belief.mean << at.x, at.vx, at.y, at.vy;
  const double p = noise_(0, 0), v = config_.velocity_sd * config_.velocity_sd;
  slow.belief.covariance.diagonal() << p, v, p, v;
  Mode<ConstantVelocity> fast{{config_.noise_fast}, slow.belief};
  Switching switching(2, 2);
  const double stay = config_.stay;
  switching << stay, 1 - stay, 1 - stay, stay;
  return {{slow, fast}, switching, {0.5, 0.5}};
}

ImmPdaAi::Track ImmPdaAi::track_at(const Start& at, double amplitude, std::int64_t frame) {
  const Imm imm = bank_at(at);
  return {next_id_++, frame, frame, imm, TargetAmplitude(amplitude), position_of(imm)};
}

/// Known targets are as bright as the brightest point that could be theirs.
void ImmPdaAi::add_starts(const Scan& scan) {
  for (const Start& start : starts_) {
    Track track = track_at(start, 0, scan.frame);
    track.confirmed = true;
    associate(track);
    const auto brightest = std::max_element(amplitudes_.begin(), amplitudes_.end());
    track.amplitude =
        TargetAmplitude(brightest == amplitudes_.end() ? config_.start_amplitude : *brightest);
    tracks_.push_back(std::move(track));
  }
  starts_.clear();
}

bool ImmPdaAi::crowded(const Eigen::Vector2d& position) const {
  return std::any_of(tracks_.begin(), tracks_.end(), [&](const Track& track) {
    return !track.over && (track.position - position).norm() < config_.separation;
  });
}

/// The brightest first, so that of several points of one target only that one starts a track.
void ImmPdaAi::start_from_free_points(const Scan& scan) {
  free_.clear();
  for (std::uint32_t i = 0; i < measurements_.size(); ++i) {
    const Measurement& m = measurements_[i];
    if (m.free && !(m.amplitude < config_.start_amplitude)) free_.push_back(i);
  }
  std::ranges::sort(free_, [&](std::uint32_t a, std::uint32_t b) {
    const double x = measurements_[a].amplitude, y = measurements_[b].amplitude;
    return x != y ? x > y : a < b;
  });
  for (const std::uint32_t i : free_) {
    const Measurement& m = measurements_[i];
    if (crowded(m.position)) continue;
    Track track = track_at({m.position.x(), m.position.y(), 0, 0}, m.amplitude, scan.frame);
    track.confirmed = config_.confirm_hits == 1;
    tracks_.push_back(std::move(track));
  }
}

void ImmPdaAi::report(const Scan& scan, double rate, TrackLog& log) {
  for (Track& track : tracks_) {
    if (track.over && !track.confirmed) {
      log.drop(track.id, track.first_frame);
      continue;
    }
    const Gaussian<4> state = track.imm.combined();
    TrackPoint point;
    point.frame = scan.frame, point.time = scan.time, point.track_id = track.id;
    point.status = track.over        ? TrackStatus::halted
                   : track.confirmed ? TrackStatus::confirmed
                                     : TrackStatus::tentative;
    point.x = state.mean(0), point.y = state.mean(2);
    point.vx = state.mean(1) * rate, point.vy = state.mean(3) * rate;
    point.intensity = track.amplitude.mean();
    point.var_x = state.covariance(0, 0), point.var_y = state.covariance(2, 2);
    point.cov_xy = state.covariance(0, 2);
    point.mode_probability = track.imm.probability();
    log.report(point);
    if (track.over) log.drop(track.id, track.last_seen + 1);
    if (track.confirmed && track.hits == config_.confirm_hits) {
      log.confirm(track.id, track.first_frame);
    }
  }
}

template class TrackerOf<ImmPdaAi>;

}  // namespace glint

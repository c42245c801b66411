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
  return config.points == PointOrigin::units ? 16 : 1;  // P-HPMHT (21)
}

}  // namespace

ImmPdaAi::ImmPdaAi(const ImmPdaAiConfig& config, const Device& device, std::uint64_t /*seed*/)
    : config_(valid(config)),
      device_(device),
      noise_(variance_of(config) * Eigen::Matrix2d::Identity()),
      amplitude_model_(config.amplitude),
      miss_(1 - config.detection * (1 - std::exp(-config.gate / 2))) {
  check(config.life);
}

void ImmPdaAi::step(const Scan& scan, TrackLog& log) {
  if (!clock_.started()) log.set_mode_names({"cv-slow", "cv-fast"});
  const StepTime at = clock_.tick(scan);
  measure(scan);
  set_clutter();
  for (Track& track : tracks_) {
    track.imm.mix();
    track.imm.predict(at.step);
    update(track, at);
  }
  end_duplicates();
  take_cues(scan, at);
  start_known(at);
  if (config_.initiate) start_from_free_points(at);
  for (Track& track : tracks_) {
    report(track, track.imm.probability(), at, at.velocity_scale, log);
  }
  std::erase_if(tracks_, [](const Track& track) { return track.life.over(); });
}

/// Finds the points in the gate of any model, which then are free no more.
void ImmPdaAi::gate(const Imm& imm) {
  inside_.assign(points_.positions.size(), false);
  for (const AnyMode& any : imm.modes()) {
    std::visit(
        [&](const auto& mode) {
          const auto expected = predict_position(mode.belief, noise_);
          for (std::size_t i = 0; i < inside_.size(); ++i) {
            if (expected.distance(points_.positions[i]) <= config_.gate) inside_[i] = true;
          }
        },
        any);
  }
  positions_.clear(), amplitudes_.clear();
  for (std::size_t i = 0; i < inside_.size(); ++i) {
    if (!inside_[i]) continue;
    points_.claimed[i] = 1;
    positions_.push_back(points_.positions[i]);
    amplitudes_.push_back(points_.amplitudes[i]);
  }
}

void ImmPdaAi::update(Track& track, const StepTime& at) {
  gate(track.imm);
  const TargetAmplitude amplitude(track.amplitude);
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
                amplitude.log_ratio(amplitude_model_, amplitudes_[i], amplitude_threshold_);
          }
          log_likelihood[j] = pda_weights(log_ratio_, miss_, beta);
          mode.belief = pda_update(mode.belief, expected, std::span(std::as_const(positions_)),
                                   std::span<const double>(beta));
        },
        track.imm.modes()[j]);
  }
  track.imm.weigh(std::span(log_likelihood).first(modes));
  track.state = track.imm.combined();
  update_life(track, at);
}

/// By the probability that one of the points is the target's own; its amplitude likewise.
void ImmPdaAi::update_life(Track& track, const StepTime& at) const {
  const std::size_t points = positions_.size();
  double own = 0, amplitude = 0;
  for (std::size_t j = 0; j < track.imm.modes().size(); ++j) {
    for (std::size_t i = 0; i < points; ++i) {
      const double beta = track.imm.probability()[j] * beta_[j * (points + 1) + i + 1];
      own += beta, amplitude += beta * amplitudes_[i];
    }
  }
  if (own > 0) {
    TargetAmplitude mean(track.amplitude);
    mean.update(amplitude / own, own);
    track.amplitude = mean.mean();
  }
  const bool seen = own >= 0.5;
  if (seen) track.last_seen = at.frame;
  track.life.see(config_.life, seen);
}

/// Of two tracks on one target the older goes on, unless the younger alone is confirmed.
void ImmPdaAi::end_duplicates() {
  for (std::size_t b = 1; b < tracks_.size(); ++b) {
    Track& younger = tracks_[b];
    for (std::size_t a = 0; a < b && !younger.life.over(); ++a) {
      Track& older = tracks_[a];
      if (!older.near(younger.position(), config_.separation)) continue;
      const bool younger_is_surer = younger.life.confirmed() && !older.life.confirmed();
      (younger_is_surer ? older : younger).life.end();
    }
  }
}

void ImmPdaAi::restored() const {
  const Imm bank = bank_at({});
  for (const Track& track : tracks_) {
    require_frame_number(track.last_seen);
    require_bytes(track.imm.alike(bank), "a target moves by other models");
  }
}

/// Both models at the target.
Imm ImmPdaAi::bank_at(const KnownTarget& target) const {
  Mode<ConstantVelocity> slow{{config_.noise_slow}, {}};
  slow.belief.mean = target.state;
  const double sd = target.position_sd;
  const double p = std::isnan(sd) ? noise_(0, 0) : sd * sd;
  const double v = config_.velocity_sd * config_.velocity_sd;
  slow.belief.covariance.diagonal() << p, v, p, v;
  Mode<ConstantVelocity> fast{{config_.noise_fast}, slow.belief};
  return {{slow, fast}, staying(2, config_.stay), {0.5, 0.5}};
}

void ImmPdaAi::add(const Imm& imm, double amplitude, bool known, const StepTime& at) {
  tracks_.push_back(
      {{next_id_++, at.frame, at.frame, TrackLife(config_.life, known), amplitude, imm.combined()},
       imm});
}

/// A tentative track beside the new one ends in the next scan.
void ImmPdaAi::take_cues(const Scan& scan, const StepTime& at) {
  for (const Cue& cue : scan.cues) {
    const bool followed = std::ranges::any_of(tracks_, [&](const Track& track) {
      return track.life.confirmed() && track.near({cue.x, cue.y}, config_.separation);
    });
    const bool told = std::ranges::any_of(known_, [&](const KnownTarget& target) {
      return target.near({cue.x, cue.y}, config_.separation);
    });
    if (!followed && !told) known_.push_back(known_target(cue, at.velocity_scale, 0));
  }
}

/// Known targets are as bright as the brightest point that could be theirs.
void ImmPdaAi::start_known(const StepTime& at) {
  for (const KnownTarget& target : known_) {
    const Imm imm = bank_at(target);
    gate(imm);
    const auto brightest = std::ranges::max_element(amplitudes_);
    add(imm, brightest == amplitudes_.end() ? config_.start_amplitude : *brightest, true, at);
  }
  known_.clear();
}

bool ImmPdaAi::near_a_track(const Eigen::Vector2d& position) const {
  return std::ranges::any_of(
      tracks_, [&](const Track& track) { return track.near(position, config_.separation); });
}

/// The brightest first, so that of several points of one target only that one starts a track.
void ImmPdaAi::start_from_free_points(const StepTime& at) {
  const std::vector<double>& amplitude = points_.amplitudes;
  free_.clear();
  for (std::uint32_t i = 0; i < amplitude.size(); ++i) {
    if (points_.free(i) && !(amplitude[i] < config_.start_amplitude)) free_.push_back(i);
  }
  std::ranges::sort(free_, [&](std::uint32_t a, std::uint32_t b) {
    return amplitude[a] != amplitude[b] ? amplitude[a] > amplitude[b] : a < b;
  });
  for (const std::uint32_t i : free_) {
    const Eigen::Vector2d& position = points_.positions[i];
    if (near_a_track(position)) continue;
    add(bank_at({{position.x(), 0, position.y(), 0}}), amplitude[i], false, at);
  }
}

template class TrackerOf<ImmPdaAi>;

}  // namespace glint

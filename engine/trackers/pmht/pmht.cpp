// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/pmht/pmht.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "glint/engine/trackers/pmht/mmpf_pmht.hpp"
#include "glint/engine/tracks/tracker_state.hpp"

namespace glint {
namespace {

constexpr double kHit = 0.25;  // number of points of a track that was seen

KalmanBank bank_of(const PmhtConfig& config, const PmhtStart& start, std::uint64_t /*seed*/,
                   std::int64_t /*track*/) {
  return {pmht_bank(config, start), config.measurement_variance};
}

ParticleBank bank_of(const MmpfPmhtConfig& config, const PmhtStart& start, std::uint64_t seed,
                     std::int64_t track) {
  return {pmht_bank(config, start), config.particles, config.measurement_variance, seed, track};
}

}  // namespace

template <class Config, class Bank>
PmhtTracker<Config, Bank>::PmhtTracker(const Config& config, const Device&, std::uint64_t seed)
    : config_(valid(config)),
      seed_(seed),
      settings_{.origins = {.detection = config.detection},
                .variance = config.measurement_variance,
                .mixture = config.association == PmhtAssociation::mixture,
                .iterations = config.iterations,
                .tolerance = config.tolerance} {
  check(config);
}

template <class Config, class Bank>
void PmhtTracker<Config, Bank>::restored() const {
  const Bank bank = bank_of(config_, PmhtStart{{0, 0}, {0, 0}}, seed_, 0);
  for (const Track& track : tracks_) {
    require_frame_number(track.last_seen);
    require_bytes(track.bank.alike(bank), "a target moves by other models");
  }
}

/// The numbers are those of the steps in docs/trackers/pmht-imm.md. Tentative tracks get what the
/// confirmed ones leave.
template <class Config, class Bank>
void PmhtTracker<Config, Bank>::step(const Scan& scan, TrackLog& log) {
  if (!clock_.started()) log.set_mode_names(pmht_mode_names(config_));
  const StepTime at = clock_.tick(scan);
  elapsed_ = config_.clock == TimeUnit::frames ? at.step
                                               : scan.time - std::exchange(last_time_, scan.time);
  take_points(scan);
  predict();            // 7
  associate(true, at);  // 2-6
  associate(false, at);
  end_duplicates();
  take_cues(scan, at);
  for (const PmhtStart& start : known_) add(start, TrackPoint::kUnknown, true, at);
  known_.clear();
  start_tracks(at);  // 1
  report(at, log);
  std::erase_if(tracks_, [](const Track& track) { return track.life.over(); });
}

/// Velocities of tracks times this are px/s.
template <class Config, class Bank>
double PmhtTracker<Config, Bank>::rate(const StepTime& at) const {
  return config_.clock == TimeUnit::frames ? at.velocity_scale : 1;
}

/// A tentative track beside the new one ends in the next scan.
template <class Config, class Bank>
void PmhtTracker<Config, Bank>::take_cues(const Scan& scan, const StepTime& at) {
  const auto variance = [](double sd) { return std::isnan(sd) ? 0 : sd * sd; };
  for (const Cue& cue : scan.cues) {
    const bool followed = std::ranges::any_of(tracks_, [&](const Track& track) {
      return track.life.confirmed() && track.near({cue.x, cue.y}, config_.separation);
    });
    const bool told = std::ranges::any_of(known_, [&](const PmhtStart& start) {
      return (start.position - Eigen::Vector2d(cue.x, cue.y)).norm() < config_.separation;
    });
    if (followed || told) continue;
    const KnownTarget target = known_target(cue, rate(at), config_.speed_max);
    known_.push_back({{cue.x, cue.y},
                      {target.state(1), target.state(3)},
                      1,
                      variance(target.position_sd),
                      variance(target.velocity_sd)});
  }
}

template <class Config, class Bank>
void PmhtTracker<Config, Bank>::take_points(const Scan& scan) {
  points_.take(scan);
  const auto of_targets =
      std::ranges::count_if(tracks_, [](const Track& track) { return track.life.confirmed(); });
  settings_.origins.clutter =
      config_.clutter_density > 0
          ? config_.clutter_density
          : points_.false_density(static_cast<std::size_t>(of_targets),
                                  config_.measurement_variance, config_.gate);
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
    pmht_gate(follower, track.position(), config_.gate, points_.positions, pairs_);
    for (std::size_t m = 0; m < track.bank.probability().size(); ++m) {
      modes_.push_back(track.bank.mode(m));
    }
    followers_.push_back(&track);
  }
  std::erase_if(pairs_, [&](const PmhtPair& pair) { return !points_.free(pair.point); });
}

template <class Config, class Bank>
void PmhtTracker<Config, Bank>::associate(bool confirmed, const StepTime& at) {
  gate(confirmed);
  if (followers_.empty()) return;
  const std::size_t models = modes_.size() / followers_.size();
  em_.run(settings_, points_.positions, pairs_, models, modes_,
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
      points_.claimed[j] += z, track.weight += z, amplitude += z * points_.amplitudes[j];
      track.ratio += per_density * std::exp(expected.log_density(points_.positions[j]));
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
    const bool near = std::any_of(
        tracks_.begin(), tracks_.begin() + static_cast<std::ptrdiff_t>(b), [&](const Track& older) {
          return older.life.confirmed() && older.near(younger.position(), config_.separation);
        });
    younger.merged = near ? younger.merged + 1 : 0;
    const bool for_long = config_.merge_scans > 0 && younger.merged >= config_.merge_scans;
    if (near && (!younger.life.confirmed() || for_long)) younger.life.end();
  }
}

template <class Config, class Bank>
void PmhtTracker<Config, Bank>::add(const PmhtStart& start, double amplitude, bool known,
                                    const StepTime& at) {
  const std::int64_t id = next_id_++;
  Track track{{id, at.frame, at.frame, TrackLife(config_.life, known), amplitude},
              bank_of(config_, start, seed_, id)};
  track.state = track.bank.state();
  tracks_.push_back(std::move(track));
}

template <class Config, class Bank>
bool PmhtTracker<Config, Bank>::crowded(const Eigen::Vector2d& position) const {
  return std::ranges::any_of(
      tracks_, [&](const Track& track) { return track.near(position, config_.separation); });
}

template <class Config, class Bank>
void PmhtTracker<Config, Bank>::start_tracks(const StepTime& at) {
  if (!config_.initiate) return;
  const auto pairs = starts_.next(points_, config_.start_amplitude, config_.speed_max * elapsed_);
  if (!(elapsed_ > 0)) return;
  for (const TwoPointStart& pair : pairs) {
    if (crowded(pair.now.position)) continue;
    add({pair.now.position, (pair.now.position - pair.before.position) / elapsed_, elapsed_},
        pair.now.amplitude, false, at);
  }
}

template <class Config, class Bank>
void PmhtTracker<Config, Bank>::report(const StepTime& at, TrackLog& log) {
  for (Track& track : tracks_) {
    glint::report(track, track.bank.probability(), at, rate(at), log);
  }
}

template class TrackerOf<PmhtTracker<PmhtConfig, KalmanBank>>;
template class TrackerOf<PmhtTracker<MmpfPmhtConfig, ParticleBank>>;
template class PmhtTracker<PmhtConfig, KalmanBank>;
template class PmhtTracker<MmpfPmhtConfig, ParticleBank>;

}  // namespace glint

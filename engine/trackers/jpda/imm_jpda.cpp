// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/jpda/imm_jpda.hpp"

#include "glint/engine/tracks/tracker_state.hpp"

#include <algorithm>
#include <cmath>

namespace glint {
namespace {

/// Tentative tracks are many and short: for them each scan stands alone.
ImmWindowConfig single_scan(ImmWindowConfig config) {
  config.window = 1;
  return config;
}

/// Where all points so far lie in one place: that over which one scatters [px^2].
double least_area(const ImmJpdaConfig& config) {
  const bool polar = config.measurement == MeasuredQuantity::range_azimuth;
  return polar ? config.range_sd * config.range_sd : config.measurement_variance;
}

}  // namespace

ImmJpda::ImmJpda(const ImmJpdaConfig& config, const Device&, std::uint64_t /*seed*/)
    : config_(valid(config)),
      confirmed_{SensorWindow(config, config), {}},
      tentative_{SensorWindow(single_scan(config), config), {}} {
  check(config);
}

void ImmJpda::restored() const {
  const Imm bank = imm_jpda_bank(config_, {});
  for (const TrackSet* set : {&confirmed_, &tentative_}) {
    set->window.require_alike(bank);
    require_bytes(set->window.targets() == set->tracks.size(), "tracks and targets do not fit");
    for (const PointTrack& track : set->tracks) require_frame_number(track.last_seen);
  }
}

void ImmJpda::TrackSet::add(PointTrack track, const Imm& bank) {
  window.add(bank);
  tracks.push_back(std::move(track));
}

void ImmJpda::TrackSet::remove(std::size_t i) {
  window.remove(i);
  tracks.erase(tracks.begin() + static_cast<std::ptrdiff_t>(i));
}

/// Tentative tracks get the points that the confirmed ones leave.
void ImmJpda::step(const Scan& scan, TrackLog& log) {
  if (!clock_.started()) log.set_mode_names(imm_jpda_modes(config_));
  const StepTime at = clock_.tick(scan);
  elapsed_ = config_.clock == TimeUnit::frames ? at.step
                                               : scan.time - std::exchange(last_time_, scan.time);
  read_points(scan);
  offered_.clear();
  for (std::uint32_t j = 0; j < points_.positions.size(); ++j) offered_.push_back(j);
  associate(confirmed_, at);
  std::erase_if(offered_, [&](std::uint32_t j) { return !points_.free(j); });
  associate(tentative_, at);
  end_duplicates();
  take_cues(scan, at);
  start_known(at);
  start_tracks(at);
  report(confirmed_, at, log);
  report(tentative_, at, log);
  move_confirmed();
}

void ImmJpda::read_points(const Scan& scan) {
  place_ << scan.sensor_x, scan.sensor_y;
  points_.take(scan);
  density_ = config_.clutter_density > 0
                 ? config_.clutter_density
                 : points_.false_density(confirmed_.tracks.size(), least_area(config_));
}

void ImmJpda::associate(TrackSet& set, const StepTime& at) {
  if (set.tracks.empty() && config_.reading != WindowReading::restart) return;
  positions_.clear();
  for (const std::uint32_t j : offered_) positions_.push_back(points_.positions[j]);
  const MultiscanReport report = set.window.step(positions_, place_, density_, elapsed_);
  count(report, &set == &confirmed_ && config_.window > 1);
  update(set, at);
}

void ImmJpda::count(const MultiscanReport& report, bool windowed) {
  ++scans_, approximate_ += report.scan.approximate > 0;
  trimmed_ += windowed && report.trimmed > 0, independent_ += windowed && report.independent > 0;
  largest_ = std::max(largest_, report.scan.largest);
}

void ImmJpda::update(TrackSet& set, const StepTime& at) {
  for (std::size_t i = 0; i < set.tracks.size(); ++i) {
    PointTrack& track = set.tracks[i];
    track.state = set.window.estimate(i).combined();
    const double missed = set.window.missed(i);
    double amplitude = 0;
    for (std::size_t k = 0; k < set.window.gated(i).size(); ++k) {
      const std::uint32_t j = offered_[set.window.gated(i)[k]];
      const double share = set.window.shares(i)[k];
      points_.claimed[j] += share, amplitude += share * points_.amplitudes[j];
    }
    const bool seen = missed < 0.5;
    if (seen) track.amplitude = amplitude / (1 - missed), track.last_seen = at.frame;
    // By Bayes' rule, the likelihood of its points over that of clutter alone.
    const double ratio = (1 - config_.detection) / std::max(missed, 1e-12);
    track.life.see(config_.life, seen, ratio, at.step);
  }
}

/// Of two tracks on one target the tentative one ends, or the younger.
void ImmJpda::end_duplicates() {
  const auto beside = [&](std::span<const PointTrack> older, const PointTrack& track) {
    return std::ranges::any_of(older, [&](const PointTrack& other) {
      return other.near(track.position(), config_.separation);
    });
  };
  const std::span<PointTrack> confirmed(confirmed_.tracks), tentative(tentative_.tracks);
  for (std::size_t b = 1; b < confirmed.size(); ++b) {
    PointTrack& younger = confirmed[b];
    younger.merged = beside(confirmed.first(b), younger) ? younger.merged + 1 : 0;
    if (config_.merge_scans > 0 && younger.merged >= config_.merge_scans) younger.life.end();
  }
  for (std::size_t b = 0; b < tentative.size(); ++b) {
    if (beside(confirmed, tentative[b]) || beside(tentative.first(b), tentative[b])) {
      tentative[b].life.end();
    }
  }
}

/// Velocities of tracks times this are px/s.
double ImmJpda::rate(const StepTime& at) const {
  return config_.clock == TimeUnit::frames ? at.velocity_scale : 1;
}

/// A tentative track beside the new one ends in the next scan.
void ImmJpda::take_cues(const Scan& scan, const StepTime& at) {
  for (const Cue& cue : scan.cues) {
    const bool followed = std::ranges::any_of(confirmed_.tracks, [&](const PointTrack& track) {
      return track.near({cue.x, cue.y}, config_.separation);
    });
    const bool told = std::ranges::any_of(known_, [&](const KnownTarget& target) {
      return target.near({cue.x, cue.y}, config_.separation);
    });
    if (!followed && !told) known_.push_back(known_target(cue, rate(at), config_.speed_max));
  }
}

void ImmJpda::start_known(const StepTime& at) {
  for (const KnownTarget& target : known_) {
    const Eigen::Vector4d& mean = target.state;
    const bool said = !std::isnan(target.position_sd);
    const double sd = said ? target.position_sd : config_.position_sd;
    const double speed = std::isnan(target.velocity_sd) ? config_.velocity_sd : target.velocity_sd;
    const Eigen::Matrix2d p = sd > 0 ? Eigen::Matrix2d(sd * sd * Eigen::Matrix2d::Identity())
                                     : confirmed_.window.noise_at({mean(0), mean(2)}, place_);
    Gaussian<4> state;
    state.mean = mean;
    state.covariance *= speed * speed;
    state.covariance(Eigen::seqN(0, 2, 2), Eigen::seqN(0, 2, 2)) = p;
    add(confirmed_, state, TrackPoint::kUnknown, at);
  }
  known_.clear();
}

void ImmJpda::add(TrackSet& set, const Gaussian<4>& state, double amplitude, const StepTime& at) {
  const bool known = &set == &confirmed_;
  set.add({next_id_++, at.frame, at.frame, TrackLife(config_.life, known), amplitude, state},
          imm_jpda_bank(config_, state));
}

bool ImmJpda::near_a_track(const Eigen::Vector2d& position) const {
  const auto near = [&](const PointTrack& track) {
    return track.near(position, config_.separation);
  };
  return std::ranges::any_of(confirmed_.tracks, near) ||
         std::ranges::any_of(tentative_.tracks, near);
}

/// From points of two scans in a row; the velocity is as uncertain as their positions make it.
void ImmJpda::start_tracks(const StepTime& at) {
  if (!config_.initiate) return;
  const auto pairs = starts_.next(points_, config_.start_amplitude, config_.speed_max * elapsed_);
  if (!(elapsed_ > 0)) return;
  Eigen::Matrix2d axis;  // of position and velocity, in units of a position's covariance
  axis << 1, 1 / elapsed_, 1 / elapsed_, 2 / (elapsed_ * elapsed_);
  for (const TwoPointStart& pair : pairs) {
    if (near_a_track(pair.now.position)) continue;
    const Eigen::Vector2d velocity = (pair.now.position - pair.before.position) / elapsed_;
    Gaussian<4> state;
    state.mean << pair.now.position.x(), velocity.x(), pair.now.position.y(), velocity.y();
    const Eigen::Matrix2d r = tentative_.window.noise_at(pair.now.position, place_);
    state.covariance << r(0, 0) * axis, r(0, 1) * axis, r(1, 0) * axis, r(1, 1) * axis;
    add(tentative_, state, pair.now.amplitude, at);
  }
}

/// Removes the tracks that have ended; tentative ones that are confirmed now change sets.
void ImmJpda::move_confirmed() {
  for (TrackSet* set : {&confirmed_, &tentative_}) {
    for (std::size_t i = set->tracks.size(); i-- > 0;) {
      if (set->tracks[i].life.over()) set->remove(i);
    }
  }
  for (std::size_t i = 0; i < tentative_.tracks.size();) {
    if (!tentative_.tracks[i].life.confirmed()) {
      ++i;
      continue;
    }
    confirmed_.add(tentative_.tracks[i], tentative_.window.estimate(i));
    tentative_.remove(i);
  }
}

void ImmJpda::report(TrackSet& set, const StepTime& at, TrackLog& log) {
  for (std::size_t i = 0; i < set.tracks.size(); ++i) {
    glint::report(set.tracks[i], set.window.estimate(i).probability(), at, rate(at), log);
  }
}

std::vector<std::string> ImmJpda::notes() const {
  std::vector<std::string> notes;
  const auto of_scans = [this](std::int64_t count) {
    return std::to_string(count) + " of " + std::to_string(scans_) + " scans";
  };
  notes.push_back("largest cluster = " + std::to_string(largest_) + " targets");
  if (approximate_ > 0)
    notes.push_back("association by belief propagation in " + of_scans(approximate_));
  if (trimmed_ > 0)
    notes.push_back("least likely points left out of the window in " + of_scans(trimmed_));
  if (independent_ > 0) notes.push_back("scans taken one by one in " + of_scans(independent_));
  return notes;
}

template class TrackerOf<ImmJpda>;

}  // namespace glint

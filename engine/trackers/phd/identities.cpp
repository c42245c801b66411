// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/identities.hpp"

#include <algorithm>
#include <cmath>

#include "glint/engine/filters/bernoulli.hpp"
#include "glint/engine/trackers/phd/cued_particles.hpp"
#include "glint/engine/trackers/phd/peaks.hpp"

namespace glint {
namespace {

double distance(double x0, double y0, double x1, double y1) { return std::hypot(x0 - x1, y0 - y1); }

}  // namespace

void describe(FieldList& f, IdentityConfig& c) {
  f("confirm_hits", c.confirm_hits, 1, 1000, "frames", "seen this often, a track is confirmed");
  f("halt_misses", c.halt_misses, 1, 1000, "frames", "missed this often in a row, it ends");
  f("separation", c.separation, 0, 1000, "px", "no new track this near to a living one");
  f("reacquire", c.reacquire, 0, 1000, "px",
    "a lost track takes a new peak this near to its predicted position");
}

Identities::Track* Identities::labelled(const Peak& peak, std::span<const std::uint32_t> members,
                                        const Particles& p) {
  votes_.clear();
  for (const auto i : members) {
    if (p.label[i] == 0) continue;
    const auto vote = std::find_if(votes_.begin(), votes_.end(),
                                   [&](const auto& v) { return v.first == p.label[i]; });
    if (vote == votes_.end()) {
      votes_.emplace_back(p.label[i], p.weight[i]);
    } else {
      vote->second += p.weight[i];
    }
  }
  std::sort(votes_.begin(), votes_.end(), [](const auto& a, const auto& b) {
    return a.second != b.second ? a.second > b.second : a.first < b.first;
  });
  for (const auto& [label, weight] : votes_) {
    const auto track = std::find_if(tracks_.begin(), tracks_.end(),
                                    [label = label](const Track& t) { return t.id == label; });
    // A few stray particles of another track do not count.
    if (track != tracks_.end() && !track->seen && weight > 0.1 * peak.mass) return &*track;
  }
  return nullptr;
}

Identities::Track* Identities::lost_near(const Peak& peak) {
  Track* best = nullptr;
  double least = config_.reacquire;
  for (auto& t : tracks_) {
    const double d = distance(t.x, t.y, peak.x, peak.y);
    if (!t.seen && d < least) least = d, best = &t;
  }
  return best;
}

bool Identities::near_seen(const Peak& peak) const {
  return std::any_of(tracks_.begin(), tracks_.end(), [&](const Track& t) {
    return t.seen && distance(t.x, t.y, peak.x, peak.y) < config_.separation;
  });
}

// The mass is what a PHD makes of the frame before and of this one. Where none was found in the
// frame before there is nothing to go on from but that.
void Identities::weigh(Track& track, const Peak& peak, double step) const {
  // The filter lets its particles survive once, however many frames a scan is on.
  track.existence = track.mass > 0
                        ? bernoulli_update(track.existence, std::pow(survival_, step),
                                           ratio_of_mass(peak.mass, track.mass, survival_))
                        : std::min(1.0, peak.mass);
  track.mass = peak.mass;
}

std::uint32_t Identities::start(const Cue& cue, const StepTime& at) {
  for (Track& t : tracks_) {
    if (distance(t.x + at.step * t.vx, t.y + at.step * t.vy, cue.x, cue.y) >= config_.separation) {
      continue;
    }
    t.hits = std::max(t.hits, config_.confirm_hits - 1);
    t.existence = std::max(t.existence, kCueExistence);
    return 0;
  }
  Track track{next_id_++, at.frame, config_.confirm_hits};
  if (cue.moves()) track.vx = cue.vx / at.velocity_scale, track.vy = cue.vy / at.velocity_scale;
  track.x = cue.x - at.step * track.vx, track.y = cue.y - at.step * track.vy;
  track.existence = track.mass = kCueExistence;
  tracks_.push_back(track);
  return track.id;
}

void Identities::see(Track& track, const Peak& peak, double step) const {
  weigh(track, peak, step);
  track.seen = true, ++track.hits, track.misses = 0;
  track.x = peak.x, track.y = peak.y, track.vx = peak.vx, track.vy = peak.vy;
}

void Identities::assign(std::span<const Peak> peaks, std::span<const Peak> faint,
                        std::span<const std::uint32_t> members, Particles& particles,
                        const StepTime& at, std::size_t modes, TrackLog& log) {
  for (auto& t : tracks_) t.seen = false, t.x += at.step * t.vx, t.y += at.step * t.vy;
  const auto of = [&](const Peak& p) { return members.subspan(p.first, p.last - p.first); };
  // Peaks that carry a label first: no other peak may take their tracks.
  assigned_.assign(peaks.size(), 0);
  confirmed_now_.clear();
  const auto take = [&](Track& t, std::size_t k) {
    see(t, peaks[k], at.step);
    assigned_[k] = t.id;
  };
  for (std::size_t k = 0; k < peaks.size(); ++k) {
    if (Track* t = labelled(peaks[k], of(peaks[k]), particles)) take(*t, k);
  }
  for (std::size_t k = 0; k < peaks.size(); ++k) {
    if (assigned_[k] != 0) continue;
    if (Track* t = lost_near(peaks[k])) {
      take(*t, k);
    } else if (!near_seen(peaks[k])) {
      tracks_.push_back({next_id_++, at.frame});
      take(tracks_.back(), k);
    }
  }
  for (std::size_t k = 0; k < peaks.size(); ++k) {
    if (assigned_[k] == 0) continue;
    for (const auto i : of(peaks[k])) particles.label[i] = assigned_[k];
    const auto t = std::find_if(tracks_.begin(), tracks_.end(),
                                [&](const Track& u) { return u.id == assigned_[k]; });
    report(*t, peaks[k], modes, at, log);
    if (t->hits == config_.confirm_hits) confirmed_now_.push_back({t->id, t->detected, k});
  }
  pass_over(faint, members, particles, at, modes, log);
  halt_missing(at, log);
}

void Identities::pass_over(std::span<const Peak> faint, std::span<const std::uint32_t> members,
                           const Particles& particles, const StepTime& at, std::size_t modes,
                           TrackLog& log) {
  left_.clear();
  for (const Peak& peak : faint) {
    Track* t = labelled(peak, members.subspan(peak.first, peak.last - peak.first), particles);
    if (t == nullptr || std::ranges::find(left_, t->id) != left_.end()) continue;
    left_.push_back(t->id);
    weigh(*t, peak, at.step);
    report(*t, peak, modes, at, log);
  }
  for (auto& t : tracks_) {
    if (t.seen || std::ranges::find(left_, t.id) != left_.end()) continue;
    t.mass = t.existence = 0;
  }
}

void Identities::report(const Track& track, const Peak& peak, std::size_t modes, const StepTime& at,
                        TrackLog& log) const {
  TrackPoint point = point_of(peak, modes, at);
  point.track_id = track.id;
  point.existence = track.existence;
  const bool confirmed = track.seen && track.hits >= config_.confirm_hits;
  point.status = confirmed ? TrackStatus::confirmed : TrackStatus::tentative;
  log.report(point);
  if (confirmed && track.hits == config_.confirm_hits) log.confirm(track.id, 0, 0.5);
}

void Identities::halt_missing(const StepTime& at, TrackLog& log) {
  for (auto& t : tracks_) {
    if (t.seen || ++t.misses < config_.halt_misses || t.hits < config_.confirm_hits) continue;
    TrackPoint end;
    end.frame = at.frame, end.time = at.time, end.track_id = t.id;
    end.status = TrackStatus::halted;
    end.x = t.x, end.y = t.y, end.existence = t.existence;
    end.vx = t.vx * at.velocity_scale, end.vy = t.vy * at.velocity_scale;
    log.report(end);
  }
  std::erase_if(tracks_, [&](const Track& t) { return t.misses >= config_.halt_misses; });
}

}  // namespace glint

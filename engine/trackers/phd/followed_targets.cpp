// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/followed_targets.hpp"

#include <algorithm>
#include <cmath>

#include "glint/engine/filters/bernoulli.hpp"
#include "glint/engine/trackers/phd/cued_particles.hpp"

namespace glint {
namespace {

// The targets must not draw the same random numbers as the detector.
constexpr std::uint64_t kTargets = std::uint64_t{0x7A} << 56;
constexpr double kLeastOfCued = 1e-3;  // existence below which a target that was cued is given up

double distance(const Peak& a, const Peak& b) { return std::hypot(a.x - b.x, a.y - b.y); }

}  // namespace

void describe_separation(FieldList& f, FollowedTargetsConfig& c) {
  f("separation", c.separation, 0, 1000, "px",
    "no target is detected this near to a track; of two tracks the younger ends");
}

FollowedTargets::FollowedTargets(const FollowedTargetsConfig& config, const MotionConfig& motion,
                                 const Device& device, std::uint64_t seed)
    : config_(config),
      survival_(motion.survival),
      speed_max_(motion.speed_max),
      modes_(motion.bank().modes.size()),
      filters_(motion.bank(), config.target_particles, device, seed ^ kTargets) {}

// Boxes of pixels are laid around the position.
void FollowedTarget::restored() const {
  constexpr double kFar = 1e6;  // [px]
  constexpr int kMany = 1 << 30;
  require_bytes(std::abs(estimate.x) < kFar && std::abs(estimate.y) < kFar,
                "a target is too far away");
  require_frame_number(detected), require_frame_number(first_missed);
  require_bytes(existence >= 0 && existence <= 1 && support >= 0 && support <= 1,
                "a target has no such probability");
  require_bytes(hits >= 0 && hits < kMany && misses >= 0 && misses < kMany,
                "a target has no such number of hits or misses");
}

void FollowedTargets::restored() const {
  require_bytes(filters_.size() == targets_.size(), "targets and filters do not fit");
}

/// Before the frame's update, after its prediction.
void FollowedTargets::start(const Cue& cue, const StepTime& at, TrackLog& log) {
  const auto same = std::ranges::find_if(targets_, [&](const FollowedTarget& t) {
    const double step = t.detected == at.frame ? 0 : at.step;  // one of a cue is of this frame
    return std::hypot(t.estimate.x + step * t.estimate.vx - cue.x,
                      t.estimate.y + step * t.estimate.vy - cue.y) < config_.separation;
  });
  FollowedTarget* target = same == targets_.end() ? nullptr : &*same;
  if (target == nullptr) {
    filters_.add(cue, at, speed_max_);
    target = &targets_.emplace_back();
    target->id = next_id_++;
    target->hits = 0;  // the frame's update is the first
    target->existence = kCueExistence;
    target->detected = at.frame;
    target->estimate.x = cue.x, target->estimate.y = cue.y;
    target->estimate.mode_probability.resize(kMostModes);
  } else if (!target->confirmed) {
    log.confirm(target->id, target->detected);
  }
  target->cued = target->confirmed = true;
  target->existence = std::max(target->existence, kCueExistence);
}

void FollowedTargets::follow(const Frame& z, const StepTime& at, TrackLog& log,
                             std::span<const Cue> cues) {
  confirmed_now_.clear();
  filters_.predict(at.frame, at.step);
  for (const Cue& cue : cues) start(cue, at, log);
  const std::span<const TargetUpdate> updates = filters_.update(z, at.frame);
  for (std::size_t t = 0; t < targets_.size(); ++t) update_life(targets_[t], updates[t], at);
  end_duplicates();
  for (FollowedTarget& target : targets_) report(target, at, log);
  filters_.resample(at.frame);
  remove_ended();
  for (std::size_t t = 0; t < targets_.size(); ++t) confirm(t, log);
}

void FollowedTargets::confirm(std::size_t t, TrackLog& log) {
  FollowedTarget& target = targets_[t];
  if (target.confirmed || target.hits < config_.confirm_hits) return;
  target.confirmed = true;
  confirmed_now_.push_back(t);
  log.confirm(target.id, target.detected);
}

void FollowedTargets::note_support(FollowedTarget& target, double survival, double ratio,
                                   std::int64_t frame) const {
  constexpr double kLeast = 1e-100;  // so that a target that comes back can win it back
  const bool at_its_best = target.support == 1;
  // The ratio test has no survival: its S is the logarithm of this.
  if (config_.rule == LifeRule::likelihood_ratio) survival = 1;
  target.support = std::clamp(target.support * survival * ratio, kLeast, 1.0);
  if (at_its_best && target.support < 1) target.first_missed = frame;
  target.recovered = !at_its_best && target.support == 1;
}

void FollowedTargets::update_life(FollowedTarget& target, const TargetUpdate& update,
                                  const StepTime& at) const {
  const double survival = target.detected == at.frame ? 1 : std::pow(survival_, at.step);
  target.existence = bernoulli_update(target.existence, survival, update.mean_ratio);
  if (update.mean_ratio > 0) target.estimate = update.estimate;
  note_support(target, survival, update.mean_ratio, at.frame);
  bool hit = target.existence >= config_.existence;
  if (config_.rule == LifeRule::likelihood_ratio) {
    hit = target.support >= 1;
    target.ended = target.support <= config_.miss_probability;
  }
  if (hit) {
    ++target.hits;
    target.misses = 0;
    return;
  }
  ++target.misses;
  const int patience = target.confirmed ? config_.halt_misses : 1;
  if (config_.rule == LifeRule::existence) {
    // Somebody's word is worth more patience.
    target.ended = target.misses >= patience && (!target.cued || target.existence < kLeastOfCued);
  }
  target.ended = target.ended || update.mean_ratio <= 0;  // out of view
}

void FollowedTargets::end_duplicates() {
  for (std::size_t t = 1; t < targets_.size(); ++t) {
    for (std::size_t older = 0; older < t && !targets_[t].ended; ++older) {
      const bool close =
          distance(targets_[t].estimate, targets_[older].estimate) < config_.separation;
      if (!close || targets_[older].ended) continue;
      // The older track is lost and has come upon the target of the younger one.
      const bool lost = targets_[older].misses > targets_[t].misses && targets_[t].confirmed;
      (lost ? targets_[older] : targets_[t]).ended = true;
    }
  }
}

void FollowedTargets::report(FollowedTarget& target, const StepTime& at, TrackLog& log) {
  TrackPoint point = point_of(target.estimate, modes_, at);
  point.track_id = target.id;
  point.existence = target.existence;
  const bool confirmed = target.confirmed || target.hits >= config_.confirm_hits;
  // What is not likely to be there is not said to be, whatever its past.
  const bool likely = target.existence >= config_.existence;
  point.status = confirmed && likely ? TrackStatus::confirmed : TrackStatus::tentative;
  // It is likelier to live than to have ended before: then it was there in the frames between, too.
  if (confirmed && target.recovered) log.confirm(target.id, target.first_missed);
  if (target.ended) {
    if (target.support < 1) log.drop(target.id, target.first_missed);
    if (!target.confirmed) return;
    point.status = TrackStatus::halted;
  }
  log.report(point);
}

void FollowedTargets::remove_ended() {
  for (std::size_t t = targets_.size(); t-- > 0;) {
    if (!targets_[t].ended) continue;
    filters_.remove(t);
    targets_.erase(targets_.begin() + static_cast<std::ptrdiff_t>(t));
  }
}

bool FollowedTargets::detect(const Cluster& cluster, const StepTime& at, TrackLog& log) {
  const Peak& peak = cluster.peak;
  const bool followed = std::ranges::any_of(targets_, [&](const FollowedTarget& target) {
    return distance(target.estimate, peak) < config_.separation;
  });
  if (followed) return false;
  FollowedTarget target;
  target.id = next_id_++;
  const double odds = peak.mass;  // of the ratio test
  target.existence =
      config_.rule == LifeRule::existence ? std::min(1.0, peak.mass) : odds / (1 + odds);
  target.detected = at.frame;
  target.estimate = peak;
  filters_.add(cluster.particles, cluster.members, at.frame);
  report(target, at, log);
  targets_.push_back(target);
  confirm(targets_.size() - 1, log);
  return true;
}

}  // namespace glint

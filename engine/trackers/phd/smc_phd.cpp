// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/smc_phd.hpp"

#include <span>

#include "glint/engine/trackers/phd/cued_particles.hpp"
#include "glint/engine/trackers/phd/kmeans.hpp"
#include "glint/engine/tracks/tracker_state.hpp"

namespace glint {

namespace {

/// How a confirmed track is traced back.
FollowedTargetsConfig traced(const SmcPhdConfig& config) {
  FollowedTargetsConfig c;
  c.existence = config.existence;
  c.confirm_hits = config.identity.confirm_hits, c.halt_misses = config.identity.halt_misses;
  c.separation = config.identity.separation;
  return c;
}

}  // namespace

SmcPhd::SmcPhd(const SmcPhdConfig& config, const Device& device, std::uint64_t seed)
    : config_(valid(config)),
      seed_(seed),
      mode_names_(config.bank().names),
      appearance_(config),
      filter_(config, device, seed),
      identities_(config.identity, config.survival),
      noise_(config.noise_adaptation),
      backward_(traced(config), config, config.backward_frames, device, seed) {}

void SmcPhd::step(const Scan& scan, TrackLog& log) {
  if (scan.whitened.width() == 0) return;
  if (!clock_.started()) log.set_mode_names(mode_names_);
  if (appearance_.look_at(scan)) {
    filter_.set_appearance(appearance_), backward_.set_appearance(appearance_);
  }
  const StepTime at = clock_.tick(scan);
  const auto scales = noise_.fixed() ? std::span<const float>() : noise_.scales(filter_.labels());
  filter_.predict(scan.whitened, scan.frame, at.step, no_mask_, scales);
  for (const Cue& cue : scan.cues) {
    if (const auto id = identities_.start(cue, at)) filter_.add(cue, at, kCueExistence, id);
  }
  filter_.update(scan.whitened, scan.frame);
  report(scan, at, log);
  filter_.resample(scan.frame);
}

/// Fills found_ and faint_, and returns their members.
std::span<const std::uint32_t> SmcPhd::find_peaks(const Scan& scan) {
  constexpr double kFaint = 0.004;  // of the least mass of a target
  Particles& particles = filter_.particles();
  faint_.clear();
  if (config_.states == StateExtraction::kmeans) {
    const auto frame = static_cast<std::uint64_t>(scan.frame);
    found_ = kmeans_states(particles, random_key(seed_, frame, Purpose::kmeans), kmeans_members_);
    return kmeans_members_;
  }
  found_.clear();
  for (const Peak& peak : peaks_.find(
           particles, filter_.runs(), scan.whitened.width(), scan.whitened.height(),
           appearance_.spread().half_width,
           {kFaint * config_.existence, appearance_.cluster_radius(config_.cluster_radius)})) {
    (peak.mass >= config_.existence ? found_ : faint_).push_back(peak);
  }
  return peaks_.members();
}

void SmcPhd::report(const Scan& scan, const StepTime& at, TrackLog& log) {
  const std::span<const std::uint32_t> members = find_peaks(scan);
  Particles& particles = filter_.particles();
  identities_.assign(found_, faint_, members, particles, at, mode_names_.size(), log);
  noise_.update(found_, members, particles);
  trace_back(scan, at, found_, members, log);
  filter_.send_labels();
}

void SmcPhd::trace_back(const Scan& scan, const StepTime& at, std::span<const Peak> found,
                        std::span<const std::uint32_t> members, TrackLog& log) {
  if (config_.backward_frames == 0) return;
  for (const Identities::Confirmed& track : identities_.confirmed_now()) {
    const Peak& peak = found[track.peak];
    const Cluster cluster{peak, filter_.particles(),
                          members.subspan(peak.first, peak.last - peak.first)};
    backward_.trace(cluster, {track.id, track.detected, scan.frame}, log);
  }
  positions_.clear();
  identities_.each_seen([&](std::uint32_t id, double x, double y) {
    positions_.push_back({id, x, y});
  });
  backward_.remember(scan.whitened, at, positions_);
}

template class TrackerOf<SmcPhd>;

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/mm_phd.hpp"

#include "glint/engine/tracks/tracker_state.hpp"

namespace glint {

void describe(FieldList& f, MmPhdConfig& c) {
  describe(f, static_cast<PhdFilterConfig&>(c));
  f("existence", c.existence, 0.01, 1, "",
    "a frame with at least this existence probability is a hit, and with less a miss, in which the "
    "track is tentative; and the least mass of a peak");
  describe_found_target(f, c, c);
  f("confirm_hits", c.confirm_hits, 1, 1000, "frames",
    "a track is confirmed with this many hits, the detection included");
  f("halt_misses", c.halt_misses, 1, 1000, "frames",
    "with this many misses in a row a confirmed track ends; a tentative one does at once");
  describe_separation(f, c);
  f("backward_frames", c.backward_frames, 0, 1000, "frames",
    "how far a confirmed track is traced back before its detection; 0 never");
}

MmPhd::MmPhd(const MmPhdConfig& config, const Device& device, std::uint64_t seed)
    : least_mass_(valid(config).existence),
      mode_names_(config.bank().names),
      appearance_(config),
      detector_(config, device, seed),
      targets_(config, config, device, seed),
      backward_(config, config, config.backward_frames, device, seed) {}

void MmPhd::step(const Scan& scan, TrackLog& log) {
  if (scan.whitened.width() == 0) return;
  if (!clock_.started()) log.set_mode_names(mode_names_);
  if (appearance_.look_at(scan)) {
    detector_.set_appearance(appearance_);
    targets_.set_appearance(appearance_);
    backward_.set_appearance(appearance_);
  }
  const StepTime at = clock_.tick(scan);
  targets_.follow(scan.whitened, at, log, scan.cues);
  detect(scan.whitened, at, log);
  const std::span<const FollowedTarget> targets = targets_.targets();
  for (const std::size_t t : targets_.confirmed_now()) {
    backward_.trace(targets_.filters(), t, {targets[t].id, targets[t].detected, at.frame}, log);
  }
  positions_.clear();
  for (const FollowedTarget& t : targets) positions_.push_back({t.id, t.estimate.x, t.estimate.y});
  backward_.remember(scan.whitened, at, positions_);
}

void MmPhd::detect(const Frame& z, const StepTime& at, TrackLog& log) {
  detector_.update(z, at, targets_.targets());
  for (const Cluster& cluster : detector_.find(least_mass_)) {
    targets_.detect(cluster, at, log);
    detector_.remove(cluster);
  }
  detector_.resample(at.frame);
}

template class TrackerOf<MmPhd>;

}  // namespace glint

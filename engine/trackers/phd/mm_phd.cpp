// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/mm_phd.hpp"

#include "glint/engine/tracks/tracker_state.hpp"

namespace glint {

MmPhd::MmPhd(const MmPhdConfig& config, const Device& device, std::uint64_t seed)
    : config_(config),
      bank_(config.bank()),
      appearance_(config),
      search_(config, device, seed),
      targets_(config.known_targets(), bank_, device, seed),
      backward_(config.known_targets(), bank_, config.backward_frames, device, seed) {}

void MmPhd::step(const Scan& scan, TrackLog& log) {
  if (scan.whitened.width() == 0) return;
  if (!clock_.started()) log.set_mode_names(bank_.names);
  if (appearance_.look_at(scan)) {
    search_.set_appearance(appearance_);
    targets_.set_appearance(appearance_);
    backward_.set_appearance(appearance_);
  }
  const StepTime at = clock_.tick(scan);
  targets_.follow(scan.whitened, at, log);
  detect(scan.whitened, at, log);
  for (const std::size_t t : targets_.confirmed_now()) backward_.trace(targets_, t, at.frame, log);
  backward_.remember(scan.whitened, at, targets_.targets());
}

// Tracked targets are masked in the detector only. P-PHD (36)
void MmPhd::detect(const Frame& z, const StepTime& at, TrackLog& log) {
  const int half_width = appearance_.spread().half_width;
  targets_.boxes(appearance_.mask_half_width(config_.mask_half_width), boxes_);
  mask_.set(boxes_, z.width(), z.height());
  search_.predict(z, at.frame, at.step, mask_);
  search_.update(z, at.frame);
  const double radius = appearance_.cluster_radius(config_.cluster_radius);
  const auto peaks = peaks_.find(search_.particles(), search_.runs(), z.width(), z.height(),
                                 half_width, {config_.existence, radius});
  for (const Peak& peak : peaks) {
    const auto members = peaks_.members(peak);
    targets_.detect(peak, search_.particles(), members, at, log);
    search_.remove(members);
  }
  search_.resample(at.frame);
}

template class TrackerOf<MmPhd>;

}  // namespace glint

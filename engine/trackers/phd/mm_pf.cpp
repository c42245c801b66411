// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/mm_pf.hpp"

#include "glint/engine/tracks/tracker_state.hpp"

namespace glint {

void describe(FieldList& f, MmPfConfig& c) {
  describe(f, static_cast<PhdFilterConfig&>(c));
  f("false_probability", c.false_probability, 1e-12, 0.5, "",
    "a target is declared at odds of (1 - miss_probability) / false_probability");
  f("miss_probability", c.miss_probability, 1e-6, 0.5, "",
    "a track ends when the likelihood ratio has fallen to this since its best");
  f.automatic("cluster_radius", c.cluster_radius, 0, 20, "px",
              "half side of a target's particle box; auto is half the window of the point spread");
  f("target_particles", c.target_particles, 10, 1000000, "", "particles that follow a target");
  f.automatic("mask_half_width", c.mask_half_width, 0, 1000, "px",
              "the search is blind this far around tracked targets; auto is half the window");
  f("separation", c.separation, 0, 1000, "px",
    "no target is declared this near to a track; of two tracks the younger ends");
}

FollowedTargetsConfig MmPfConfig::known_targets() const {
  FollowedTargetsConfig config;
  config.rule = LifeRule::likelihood_ratio;
  config.particles = target_particles;
  config.confirm_hits = 1;
  config.miss = miss_probability;
  config.separation = separation;
  return config;
}

MmPf::MmPf(const MmPfConfig& config, const Device& device, std::uint64_t seed)
    : config_(config),
      bank_(config.bank()),
      appearance_(config),
      search_(config, device, seed, CloudWeight::odds),
      targets_(config.known_targets(), bank_, device, seed) {}

void MmPf::step(const Scan& scan, TrackLog& log) {
  if (scan.whitened.width() == 0) return;
  if (!clock_.started()) log.set_mode_names(bank_.names);
  if (appearance_.look_at(scan)) {
    search_.set_appearance(appearance_);
    targets_.set_appearance(appearance_);
  }
  const StepTime at = clock_.tick(scan);
  targets_.follow(scan.whitened, at, log);
  search(scan.whitened, at, log);
}

void MmPf::search(const Frame& z, const StepTime& at, TrackLog& log) {
  const int half_width = appearance_.spread().half_width;
  targets_.boxes(appearance_.mask_half_width(config_.mask_half_width), boxes_);
  mask_.set(boxes_, z.width(), z.height());
  search_.predict(z, at.frame, at.step, mask_);
  search_.update(z, at.frame);
  // Boers and Driessen's test on the odds of a target that may have been born at any time.
  const double odds = search_.expected();
  const double wanted = (1 - config_.miss_probability) / config_.false_probability;
  if (odds >= wanted * config_.birth_mass) {
    constexpr double kShare = 0.1;  // of the odds: the biggest cluster has more
    const double radius = appearance_.cluster_radius(config_.cluster_radius);
    const auto peaks = peaks_.find(search_.particles(), search_.runs(), z.width(), z.height(),
                                   half_width, {kShare * odds, radius});
    if (!peaks.empty()) {
      const auto members = peaks_.members(peaks.front());
      targets_.detect(peaks.front(), search_.particles(), members, at, log);
      search_.clear();
      return;
    }
  }
  search_.resample(at.frame);
}

template class TrackerOf<MmPf>;

}  // namespace glint

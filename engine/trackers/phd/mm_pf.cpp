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
  describe_found_target(f, c, c);
  describe_separation(f, c);
}

namespace {

/// Odds at which a target is declared: Boers and Driessen's test.
double declaring_odds(const MmPfConfig& c) {
  return (1 - c.miss_probability) / c.false_probability * c.birth_mass;
}

}  // namespace

MmPf::MmPf(const MmPfConfig& config, const Device& device, std::uint64_t seed)
    : declaring_odds_(declaring_odds(valid(config))),
      mode_names_(config.bank().names),
      appearance_(config),
      detector_(config, device, seed, WeightSum::odds),
      targets_(config, config, device, seed) {}

void MmPf::step(const Scan& scan, TrackLog& log) {
  if (scan.whitened.width() == 0) return;
  if (!clock_.started()) log.set_mode_names(mode_names_);
  if (appearance_.look_at(scan)) {
    detector_.set_appearance(appearance_);
    targets_.set_appearance(appearance_);
  }
  const StepTime at = clock_.tick(scan);
  targets_.follow(scan.whitened, at, log, scan.cues);
  detect(scan.whitened, at, log);
}

// Boers and Driessen's test on the odds of a target that may have been born at any time.
void MmPf::detect(const Frame& z, const StepTime& at, TrackLog& log) {
  detector_.update(z, at, targets_.targets());
  for (const Cluster& cluster : detector_.find(declaring_odds_)) {
    targets_.detect(cluster, at, log);
    detector_.remove(cluster);
  }
  detector_.resample(at.frame);
}

template class TrackerOf<MmPf>;

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/mm_phd.hpp"

namespace glint {

void describe(FieldList& f, MmPhdConfig& c) {
  describe(f, static_cast<PhdFilterConfig&>(c));
  f("existence", c.existence, 0.01, 1, "", "least existence probability of a target that is seen");
  f.automatic("cluster_radius", c.cluster_radius, 0, 20, "px",
              "half side of a target's particle box; auto is half the window of the point spread");
  f("target_particles", c.target_particles, 10, 1000000, "", "particles that follow a target");
  f.automatic("mask_half_width", c.mask_half_width, 0, 1000, "px",
              "the detector is blind this far around tracked targets; auto is half the window");
  f("confirm_hits", c.confirm_hits, 1, 1000, "frames",
    "a track is confirmed when seen this often, the detection included");
  f("halt_misses", c.halt_misses, 1, 1000, "frames",
    "missed this often in a row, a confirmed track ends; a tentative one does at once");
  f("separation", c.separation, 0, 1000, "px",
    "no target is detected this near to a track; of two tracks the younger ends");
  f("backward_frames", c.backward_frames, 0, 1000, "frames",
    "how far a confirmed track is traced back before its detection; 0 never");
}

FollowedTargetsConfig MmPhdConfig::known_targets() const {
  FollowedTargetsConfig config;
  config.particles = target_particles;
  config.survival = survival;
  config.existence = existence;
  config.confirm_hits = confirm_hits;
  config.halt_misses = halt_misses;
  config.separation = separation;
  return config;
}

}  // namespace glint

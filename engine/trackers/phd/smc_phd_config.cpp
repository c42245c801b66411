// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/smc_phd.hpp"

namespace glint {

void describe(FieldList& f, SmcPhdConfig& c) {
  describe(f, static_cast<PhdFilterConfig&>(c));
  f("states", c.states, {{"peaks", StateExtraction::peaks}, {"kmeans", StateExtraction::kmeans}},
    "how particles become targets; kmeans is the paper's and fails as soon as n is off");
  f("existence", c.existence, 0.01, 1, "", "least mass of a reported target");
  f.automatic("cluster_radius", c.cluster_radius, 0, 20, "px",
              "half side of a target's particle box; auto is half the window of the point spread");
  f("noise_adaptation", c.noise_adaptation, 1, 1e6, "",
    "a target's process noise varies from process_noise to this many times it; 1 keeps it fixed");
  describe(f, c.identity);
  f("backward_frames", c.backward_frames, 0, 1000, "frames",
    "how far a confirmed track is traced back before its detection; 0 never");
}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/phd_filter.hpp"

namespace glint {

void describe(FieldList& f, MotionConfig& c) {
  f("motion", c.motion, {"cv", "ca", "cv+ct"},
    "constant velocity, constant acceleration, or constant velocity with turns both ways");
  f("process_noise", c.process_noise, 0, 100, "px^2/frame^3",
    "power spectral density of the acceleration (of the jerk for ca)");
  f("turn_rate", c.turn_rate, 0, 180, "deg/frame", "of the turn models");
  f("speed_max", c.speed_max, 0.01, 100, "px/frame", "fastest target along each axis");
  f("survival", c.survival, 0, 1, "", "probability that a target lives on to the next frame");
}

void describe(FieldList& f, BirthConfig& c) {
  f("birth", c.birth,
    {{"two-frame", BirthProposal::two_frame},
     {"matched-filter", BirthProposal::matched_filter},
     {"uniform", BirthProposal::uniform}},
    "where new particles are drawn; two-frame equals ten times the particles");
  f("birth_particles", c.birth_particles, 1, 10000000, "", "new particles a frame");
  f("birth_growth", c.birth_growth, 1, 1000, "",
    "in a frame so many times as large as 256x256 so many times as many are born, at most this "
    "number of times; not for uniform");
  f("birth_mass", c.birth_mass, 0, 1000, "", "expected new targets a frame");
  f("birth_threshold", c.birth_threshold, -100, 100, "sigma",
    "uniform births fall near pixels above this");
}

void describe(FieldList& f, PhdFilterConfig& c) {
  describe(f, static_cast<AppearanceConfig&>(c));
  describe(f, static_cast<MotionConfig&>(c));
  describe(f, static_cast<BirthConfig&>(c));
  f("particles_per_target", c.particles_per_target, 10, 10000000, "",
    "particles kept for each expected target");
  f("particles_max", c.particles_max, 10, 100000000, "", "particles kept in all");
  f("resampling", c.resampling,
    {{"systematic", Resampling::systematic}, {"residual", Resampling::residual}},
    "how particles are redrawn");
  f("resample_on", c.resample_on,
    {{"weight", ResampleOn::weight}, {"likelihood", ResampleOn::likelihood}},
    "what particles are redrawn by; likelihood leaves out how pixels are shared among targets");
  f("psi", c.psi, {{"window", Psi::window}, {"cell", Psi::cell}},
    "what the normaliser sums over; cell is the paper's and counts a target across cells twice");
  f("clutter", c.clutter, 0, 1000, "",
    "lambda of the normaliser in likelihood-ratio units; the paper's 1 - Phi(Th) inflates noise");
}

}  // namespace glint

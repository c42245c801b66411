// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/smc_phd.hpp"

namespace glint {

void describe(FieldList& f, SmcPhdConfig& c) {
  f.automatic(
      "psf_sigma", c.psf_sigma, 0, 2.66, "px",
      "width of the point spread; auto fits it to the brightest local maxima of the first frames");
  f("snr_low", c.snr_low, -20, 80, "dB", "weakest target: peak over noise, 20 log10");
  f("snr_high", c.snr_high, -20, 80, "dB", "strongest target");
  f("jitter", c.jitter, 0, 5, "px", "position error of the sensor, sampled per particle");
  f("motion", c.motion, {"cv", "ca", "cv+ct"},
    "constant velocity, constant acceleration, or constant velocity with turns both ways");
  f("process_noise", c.process_noise, 0, 100, "px^2/frame^3",
    "power spectral density of the acceleration (of the jerk for ca)");
  f("turn_rate", c.turn_rate, 0, 180, "deg/frame", "of the turn models");
  f("speed_max", c.speed_max, 0.01, 100, "px/frame", "fastest target along each axis");
  f("intensity_walk", c.intensity_walk, 0, 100, "sigma",
    "how far a target's peak wanders from frame to frame, in noise sigmas");
  f("survival", c.survival, 0, 1, "", "probability that a target lives on to the next frame");
  f("birth", c.birth, {"two-frame", "matched-filter", "uniform"},
    "where new particles are drawn; two-frame equals ten times the particles");
  f("birth_particles", c.birth_particles, 1, 10000000, "", "new particles a frame");
  f("birth_mass", c.birth_mass, 0, 1000, "", "expected new targets a frame");
  f("birth_threshold", c.birth_threshold, -100, 100, "sigma",
    "uniform births fall near pixels above this");
  f("particles_per_target", c.particles_per_target, 10, 10000000, "",
    "particles kept for each expected target");
  f("particles_max", c.particles_max, 10, 100000000, "", "particles kept in all");
  f("resampling", c.resampling, {"systematic", "residual"}, "how particles are redrawn");
  f("states", c.states, {"peaks", "kmeans"},
    "how the cloud becomes targets; kmeans is the paper's and fails as soon as n is off");
  f("psi", c.psi, {"window", "cell"},
    "what the normaliser sums over; cell is the paper's and counts straddling clouds twice");
  f("clutter", c.clutter, 0, 1000, "",
    "lambda of the normaliser in likelihood-ratio units; the paper's 1 - Phi(Th) inflates noise");
  f("existence", c.existence, 0.01, 1, "", "least mass of a reported target");
  f.automatic("cluster_radius", c.cluster_radius, 0, 20, "px",
              "half side of a target's particle box; auto is half the window of the point spread");
  f("confirm_hits", c.identity.confirm_hits, 1, 1000, "frames",
    "seen this often, a track is confirmed");
  f("halt_misses", c.identity.halt_misses, 1, 1000, "frames",
    "missed this often in a row, it ends");
  f("separation", c.identity.separation, 0, 1000, "px", "no new track this near to a living one");
  f("reacquire", c.identity.reacquire, 0, 1000, "px",
    "a lost track takes a new cloud this near to where it should be");
}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/imm_pda_ai/imm_pda_ai.hpp"

namespace glint {

void describe(FieldList& f, ImmPdaAiConfig& c) {
  f("points", c.points, {{"scan", PointOrigin::scan}, {"units", PointOrigin::units}},
    "points of the front end (section points), or bright 5x5 units of the frame as delivered, the "
    "paper's, which asks for frames.reciprocal if targets are dark");
  f("threshold", c.threshold,
    {{"mean", UnitThreshold::mean}, {"displayed", UnitThreshold::displayed}},
    "what a unit must exceed: the frame's mean (P-HPMHT (20)) or I_Th (23)");
  f("threshold_scale", c.threshold_scale, 0, 100, "", "multiple of that threshold");
  f.automatic("measurement_variance", c.measurement_variance, 0, 1e18, "px^2",
              "of a point's position along each axis; auto is 16 for units, 1 for points");
  f("amplitude", c.amplitude,
    {{"rayleigh", AmplitudeModel::rayleigh},
     {"gaussian", AmplitudeModel::gaussian},
     {"none", AmplitudeModel::none}},
    "what a point's amplitude says of its origin");
  f("noise_slow", c.noise_slow, 0, 1e18, "px^2/frame^3",
    "power spectral density of the acceleration, of the first model");
  f("noise_fast", c.noise_fast, 0, 1e18, "px^2/frame^3", "the same of the second model");
  f("stay", c.stay, 0, 1, "", "probability that a target keeps its model from scan to scan");
  f("detection", c.detection, 0.01, 0.9999, "", "probability that a target gives a point");
  f("gate", c.gate, 0.1, 1000, "", "squared distance of a point in sigmas; 9.21 holds 99 %");
  f.automatic(
      "clutter_density", c.clutter_density, 0, 1e12, "1/px^2",
      "density of false points; auto is the number of points over the frame's area, or over "
      "that of the box about all points where there are no frames");
  f("initiate", c.initiate, "start tracks from points that are in no track's gate");
  f("start_amplitude", c.start_amplitude, -1000, 1000, "sigma", "least amplitude of a start");
  f("velocity_sd", c.velocity_sd, 0, 1e9, "px/frame", "spread of a new target's velocity");
  f("confirm_hits", c.life.confirm_hits, 1, 1000, "scans", "seen this often ...");
  f("confirm_window", c.life.confirm_window, 1, 1000, "scans",
    "... within so many scans, a track is confirmed, else it ends");
  f("halt_misses", c.life.halt_misses, 1, 1000, "scans",
    "missed this often in a row, a track ends");
  f("separation", c.separation, 0, 1e9, "px",
    "no new track this near to a living one, and of two this near the younger ends");
}

}  // namespace glint

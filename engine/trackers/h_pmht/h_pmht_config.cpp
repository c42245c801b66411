// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "glint/engine/trackers/h_pmht/hpmht_batch.hpp"

namespace glint {

void describe(FieldList& f, HPmhtConfig& c) {
  f("intensity", c.intensity,
    {{"whitened", CellIntensity::whitened},
     {"rpim", CellIntensity::rpim},
     {"rpim-normalised", CellIntensity::rpim_normalised}},
    "what cells show: whitened pixels above noise_threshold; the frame as delivered above I_Th, "
    "which asks for frames.reciprocal; or the same of whitened pixels, which other dark objects "
    "do not disturb");
  f("noise_threshold", c.noise_threshold, 0, 100, "sigma",
    "taken off whitened pixels; what is below shows nothing");
  f("threshold", c.threshold,
    {{"subtract", CellThreshold::subtract}, {"keep", CellThreshold::keep}},
    "whether I_Th is taken off rpim pixels (m2, better in clutter) or not (m1, for clean sky)");
  f("threshold_scale", c.threshold_scale, 0, 100, "", "multiple of I_Th, P-HPMHT (23)");
  f("psf_sigma", c.psf_sigma, 0.1, 2.66, "px", "width of the point spread");
  f("snr", c.snr, -20, 80, "dB", "peak over noise that candidates are looked for with");
  f("estimate_extent", c.estimate_extent,
    "learn how far a target's intensity spreads; for extended targets");
  f.automatic("extent", c.extent, 0, 10000, "px^2",
              "variance of that, at the start; auto is psf_sigma^2 + 0.25");
  f("extent_low", c.extent_low, 0.01, 10000, "px^2", "least variance that is learnt");
  f("extent_high", c.extent_high, 0.01, 10000, "px^2", "greatest variance that is learnt");
  f("process_noise", c.process_noise, 1e-9, 1000, "px^2/frame^3",
    "power spectral density of the acceleration");
  f("estimate_process", c.estimate_process, "learn it for each target, within 0.1 to 10 times");
  f("position_variance", c.position_variance, 1e-9, 1e6, "px^2", "of a new track");
  f("velocity_variance", c.velocity_variance, 1e-9, 1e6, "px^2/frame^2", "of a new track");
  f("speed_max", c.speed_max, 0.01, 100, "px/frame", "fastest candidate");
  f("sensor_area", c.sensor_area, 1, 1e12, "px^2",
    "motion counts as often as the shots in this area; 1e12 is the paper's, the whole frame");
  f("batch", c.batch, 1, static_cast<int>(kMaxBatch), "scans", "that are looked at together");
  f("iterations", c.iterations, 1, 1000, "", "of expectation maximisation, at most, a scan");
  f("initiate", c.initiate, "look for new targets");
  f("candidate_ratio", c.candidate_ratio, -1000, 1000, "",
    "least log likelihood ratio of the two pixels of a candidate");
  f("candidates_max", c.candidates_max, 0, 100000, "", "new candidates a frame");
  f("separation", c.separation, 0, 1000, "px", "no candidate this near to a living track");
  f("duplicate", c.duplicate, 0, 1000, "px", "of two tracks this close the younger ends");
  f.automatic("confirm_count", c.confirm_count, 0, 1e9, "",
              "mean intensity that a confirmed track explains [sigma or grey levels]; auto is 3.3, "
              "and up to 4 for an snr below 12");
  f("confirm_frames", c.confirm_frames, 1, static_cast<int>(kMaxBatch), "scans", "of that mean");
  f("halt_count", c.halt_count, 0, 1e9, "", "mean intensity below which a track ends");
  f("halt_frames", c.halt_frames, 1, static_cast<int>(kMaxBatch), "scans", "of that mean");
}

double least_confirm_count(const HPmhtConfig& config) {
  constexpr double kLeast = 3.3, kMost = 4, kBelow = 12, kPerDecibel = 0.117;
  if (config.confirm_count > 0) return config.confirm_count;
  if (config.intensity == CellIntensity::rpim) return kLeast;
  return std::clamp(kLeast + kPerDecibel * (kBelow - config.snr), kLeast, kMost);
}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/frames/frames_config.hpp"

#include "glint/kernels/prepare_frame/prepare_frame.hpp"

namespace glint {

void describe(FieldList& list, FramesConfig& c) {
  list("polarity", c.polarity,
       {{"bright", Polarity::bright}, {"dark", Polarity::dark}, {"both", Polarity::both}},
       "targets are brighter than the background, darker, or either");
  list("background", c.background,
       {{"temporal", BackgroundKind::temporal},
        {"registered", BackgroundKind::registered},
        {"spatial", BackgroundKind::spatial},
        {"none", BackgroundKind::none}},
       "median over past frames, the same after registration (moving camera), median over a "
       "window, or frames that are whitened already");
  list("reciprocal", c.reciprocal, "work on 255 / I, which makes dark targets bright");
  list("reciprocal_floor", c.reciprocal_floor, 1e-3, 65535, "grey levels",
       "darker pixels count as this dark");
  list("background_frames", c.background_frames, 1, 100000, "frames",
       "span of the temporal median");
  list("background_stride", c.background_stride, 1, 10000, "frames",
       "from one sample of the temporal median to the next, once the span is reached");
  list("background_prime", c.background_prime, 0, 100000, "frames",
       "frames at the input's start that the background is learned from before the first is "
       "tracked: targets that hardly move there then stand out from it; they are held in memory "
       "where "
       "frames are pushed; 0 = none");
  list("registered_frames", c.registered_frames, 1, static_cast<int>(kMaxStack), "",
       "samples of the registered median");
  list("registered_stride", c.registered_stride, 1, 1000, "frames",
       "from one sample of the registered median to the next");
  list("max_shift", c.max_shift, 1, 1024, "px", "largest movement that registration looks for");
  list("registration_gain", c.registration_gain, 0, 1, "",
       "a shift counts only if it lowers the mean absolute difference by this share");
  list("spatial_window", c.spatial_window, 5, 4 * SpatialMedian::kMaxSpacing + 1, "px",
       "width of the spatial median");
  list("sigma_floor", c.sigma_floor, 0, 1e6, "grey levels",
       "least noise sigma; 0 = automatic: 4 for 8-bit frames, 0.5 for 16-bit ones, 1e-6 of the "
       "largest magnitude for float ones, 0.05 after reciprocal");
  list("structure", c.structure, "let the background's gradient raise sigma");
  list("ring", c.ring, "let the residual around a pixel raise sigma");
  list("ring_outer", c.ring_outer, 3, 2 * Whiten::kMaxRing + 1, "px", "width of the ring's box");
  list("ring_inner", c.ring_inner, 1, 2 * Whiten::kMaxRing - 1, "px",
       "width of the box left out of the ring");
  list("ring_clip", c.ring_clip, 1, 100, "sigma", "residuals count at most this much in the ring");
  list("clip_low", c.clip_low, -1000, 0, "sigma", "least z");
  list("clip_high", c.clip_high, 0.1, 1000, "sigma", "greatest z");
}

}  // namespace glint

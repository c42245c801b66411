// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/viterbi/viterbi.hpp"

namespace glint {

void describe(FieldList& f, ViterbiConfig& c) {
  describe_shape(f, c);
  f("speed_max", c.speed_max, 0, 20, "px/frame",
    "fastest target along each axis; rounded up to whole pixels");
  f("acceleration_max", c.acceleration_max, 0, 20, "px/frame^2",
    "how far a move may differ from the one before, along each axis; rounded up");
  f("window", c.window, 2, kMaxPathStages, "frames", "length of the paths");
  f("threshold", c.threshold, 0, 1e6, "",
    "least sum of log likelihood ratios over a window's path; the more pixels, the higher");
  f("separation", c.separation, 0, 1000, "px",
    "a path that comes this near to a better one at any frame is none; one this near to a track, "
    "on average, is its continuation");
  f("common_frames", c.common_frames, 1, kMaxPathStages, "frames",
    "a path continues a track only if both have this many frames; a shorter path is none");
  f("settled_frames", c.settled_frames, 0, kMaxPathStages, "frames",
    "a track's points older than this stay as they are");
  f("halt_frames", c.halt_frames, 1, kMaxPathStages, "frames",
    "a track ends this long after its last point; at once where the window shows too little of it");
}

}  // namespace glint

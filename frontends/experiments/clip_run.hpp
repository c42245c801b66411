// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "glint/engine/config.hpp"
#include "glint/engine/scheduler.hpp"
#include "glint/experiments/evaluation_bytes.hpp"

namespace glint {

/// A clip and what is known of it.
struct ClipInput {
  std::string frames;  ///< file, as open_source() takes it
  std::vector<TruthPoint> truth;
  double noise = 0;  ///< white noise to add [grey levels]
};

/// A tracker and its settings, "trackers.<name>".
struct ClipTracker {
  std::string name;
  ConfigSection config;
};

/// What a tracker made of a clip; OSPA and matches at a cut-off of 8 px, order 2.
struct ClipScore {
  Evaluation online, revised;
  Baseline baseline;  ///< of the matched filter on the same frames, at the online false points
};
auto fields(OneOf<ClipScore> auto& s) { return std::tie(s.online, s.revised, s.baseline); }

/// Steps the trackers over the clip, one thread: one score a tracker. `seed` is that of the noise
/// and of the trackers. Throws as open_source() does.
std::vector<ClipScore> run_clip(const ClipInput& clip, const FramesConfig& frames,
                                std::span<const ClipTracker> trackers, std::uint64_t seed);

struct ClipSize {
  int width, height;  ///< [px]
  int frames;
};
/// Frames of white noise alone: the number of tracks that each tracker confirmed.
std::vector<int> tracks_in_noise(const ClipSize& size, const FramesConfig& frames,
                                 std::span<const ClipTracker> trackers, std::uint64_t seed);

}  // namespace glint

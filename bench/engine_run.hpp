// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <string>

#include "glint/bench/harness.hpp"
#include "glint/bench/memory_source.hpp"
#include "glint/engine/tracks/tracker.hpp"

namespace glint::bench {

inline constexpr std::uint64_t kEngineSeed = 1;

/// The tracker of that name with its defaults.
std::unique_ptr<Tracker> make_tracker(const std::string& name, const Device& device);

/// Frames that a run goes through before the clock starts, and those that are timed.
struct RunLength {
  std::int64_t warm_up = 0, timed = 0;
};

struct EngineRun {
  double seconds = 0;      ///< a timed frame
  std::size_t tracks = 0;  ///< that the last frame reports
};
/// The pipeline as `glint track` runs it, with one tracker. Appends to `result` the time of a frame
/// as `name`, that of each stage, and the stages' shares.
EngineRun run_engine(const MemoryScene& scene, const std::string& tracker, const Device& device,
                     const RunLength& length, const std::string& name, Result& result);

/// A case's time that is not a median of samples.
Timing one_timing(std::string name, int threads, double seconds, std::int64_t samples);

}  // namespace glint::bench

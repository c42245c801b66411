// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

#include "glint/engine/config.hpp"
#include "glint/engine/frames/point_finder.hpp"
#include "glint/engine/scenario/scenes.hpp"
#include "glint/kernels/core/device.hpp"

namespace glint {

/// The one setting by which a tracker trades false tracks for late or missed targets, and where a
/// value for it is looked for: from `lax` to `strict` in equal steps, or in equal ratios.
struct Threshold {
  std::string_view tracker, key;
  double lax, strict;
  int steps;
  bool geometric = false;

  /// Four significant digits. 0 <= step <= steps
  double at(int step) const;
};

/// The one list of trackers that can be calibrated.
std::span<const Threshold> all_thresholds();
/// Throws ConfigError that lists the trackers if there is none for this one.
const Threshold& find_threshold(std::string_view tracker);

/// Tracks confirmed in noise, and their rate with its standard error, as if they came
/// independently of each other [1/(frame Mpx)].
struct FalseTracks {
  std::int64_t tracks = 0;
  double rate = 0, error = 0;
};

struct CalibrationOptions {
  double false_tracks = 0.1;        ///< wanted, at most [1/(frame Mpx)]
  int runs = 20;                    ///< with seeds from `seed` on
  NoiseScene noise{256, 256, 100};  ///< a run; its unit is sigma
  PointsConfig points;              ///< for trackers that feed on points
  std::uint64_t seed = 1;
  DeviceKind device = DeviceKind::tbb;
  /// Called with runs done and, at most, in all, from any thread, one call at a time.
  std::function<void(int done, int total)> progress;
};

struct Calibration {
  double value = 0;
  FalseTracks attained;  ///< in the runs that it was chosen by
  FalseTracks checked;   ///< in as many others, with the seeds that follow
  bool at_lax_end = false;
  double megapixel_frames = 0;  ///< of all runs
};

/// The laxest threshold that keeps the rate of false tracks on white noise, by bisection on common
/// seeds: the rate is taken to fall with every step. `config` is the tracker's section; the value
/// found is set in it. Does not depend on the number of workers. Throws ConfigError for a tracker
/// without a threshold and what does not fit together, std::runtime_error if no value is strict
/// enough.
Calibration calibrate(const Threshold& threshold, ConfigSection& config,
                      const CalibrationOptions& options, Workers& workers);

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "glint/engine/cue.hpp"
#include "glint/engine/scan.hpp"
#include "glint/engine/tracks/track_log.hpp"
#include "glint/kernels/core/raw_pixels.hpp"

namespace glint {

/// A raw frame that owns its pixels, the points of a scan, or both.
struct SourceFrame {
  RawPixels pixels;                   ///< points into `owner`; without width if there is no frame
  std::shared_ptr<const void> owner;  ///< keeps the pixels alive; released on any thread
  double time = 0;                    ///< [s]
  /// Given by sources that know the points; without them they are looked for in the pixels.
  std::optional<std::vector<PointMeasurement>> points;
  double sensor_x = 0, sensor_y = 0;  ///< position of the sensor of range and azimuth [px]
  bool looked = true;  ///< false: it did not look; trackers of points alone pass the frame over
  std::int64_t skipped = 0;    ///< frames lost since the one before
  std::vector<Cue> cues = {};  ///< a track starts on each in this frame
};

/// Copies the pixels row by row without gaps, and releases their owner. Throws as checked() does.
void own_pixels(SourceFrame& frame);

/// Where frames come from.
class Source {
 public:
  virtual ~Source() = default;
  /// The next frame, or nothing at the end. Throws std::runtime_error with file and remedy.
  virtual std::optional<SourceFrame> next() = 0;
  virtual std::optional<std::int64_t> frame_count() const { return std::nullopt; }
  virtual double frame_rate() const { return 1; }  ///< [1/s]
};

/// What a finished scan looks like to sinks (writers, progress, overlay). Trackers may already work
/// on later scans, so the log itself is not to be seen here, but a copy of what each tracker
/// reported of this scan when it had it: by track id, without later revisions.
struct ScanResult {
  const Scan& scan;
  std::span<const std::vector<TrackPoint>> reported;  ///< one a tracker, in their order
};

/// Where finished scans go, in order.
class Sink {
 public:
  virtual ~Sink() = default;
  virtual void take(const ScanResult& result) = 0;
};

}  // namespace glint

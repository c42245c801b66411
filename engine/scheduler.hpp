// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "glint/engine/frame_preparer.hpp"
#include "glint/engine/trackers/tracker.hpp"

namespace glint {

/// A raw frame that owns its pixels.
struct SourceFrame {
  RawPixels pixels;                   ///< points into `owner`
  std::shared_ptr<const void> owner;  ///< keeps the pixels alive
  double time = 0;                    ///< [s]
};

/// Where frames come from.
class Source {
 public:
  virtual ~Source() = default;
  /// The next frame, or nothing at the end. Throws std::runtime_error with file and remedy.
  virtual std::optional<SourceFrame> next() = 0;
  virtual std::optional<std::int64_t> frame_count() const { return std::nullopt; }
  virtual double frame_rate() const { return 1; }  ///< [1/s]
};

/// What a finished scan looks like to sinks (writers, progress, overlay).
struct ScanResult {
  const Scan& scan;
  const std::vector<const TrackLog*>& logs;  ///< one a tracker, in their order
};

/// Where finished scans go, in order.
class Sink {
 public:
  virtual ~Sink() = default;
  virtual void take(const ScanResult& result) = 0;
};

/// Reads, prepares, steps every tracker and feeds every sink: serial in-order stages of a pipeline
/// with a bounded number of frames in flight, inside the device's own arena. An exception of any
/// stage comes out here after all earlier frames were delivered to the sinks.
class Scheduler {
 public:
  Scheduler(const Device& device, FramePreparer preparer);
  void add(std::unique_ptr<Tracker> tracker);
  void add(Sink& sink);
  /// Runs to the end of the source; returns the number of frames.
  std::int64_t run(Source& source);
  const std::vector<const TrackLog*>& logs() const;
  const Tracker& tracker(std::size_t i) const;
  const FramePreparer& preparer() const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace glint

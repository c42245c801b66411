// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <stdexcept>
#include <string>
#include <vector>

#include "glint/engine/scan.hpp"
#include "glint/engine/state/bytes.hpp"
#include "glint/engine/tracks/track_log.hpp"

namespace glint {

/// What a tracker takes: pixels, points of single frames, or both.
enum class Feed { frames, points, both };

/// A tracking system. Constructed with its config, a device and a seed; the log is a function of
/// these and the scans alone. step() does not throw for data: NaN is masked, an empty scan is fine.
class Tracker {
 public:
  virtual ~Tracker() = default;
  virtual Feed feed() const = 0;
  virtual void step(const Scan& scan, TrackLog& log) = 0;  ///< one scan; may revise earlier ones
  virtual void finish(TrackLog&) {}                        ///< what batch methods still hold
  /// What was estimated or chosen on the way, for the summary and the header of track files:
  /// "psf_sigma = 1.04".
  virtual std::vector<std::string> notes() const { return {}; }
  /// All that later scans depend on, and back: a tracker made of the same config, kind of device
  /// and seed that restores it says of them what this one would, byte by byte. restore() throws
  /// BytesError. Trackers of the registry inherit both from TrackerOf.
  virtual void save(ByteWriter&) const { refuse_checkpoint(); }
  virtual void restore(ByteReader&) { refuse_checkpoint(); }

 private:
  [[noreturn]] static void refuse_checkpoint() {
    throw std::logic_error("a tracker that does not override save() has no checkpoint");
  }
};

/// A tracker T whose state is what `T::fields()` names. Its .cpp includes tracks/tracker_state.hpp
/// and instantiates TrackerOf<T> there.
template <class T>
class TrackerOf : public Tracker {
 public:
  void save(ByteWriter& to) const final;
  void restore(ByteReader& from) final;
};

}  // namespace glint

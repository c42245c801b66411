// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/engine/scan.hpp"
#include "glint/engine/tracks.hpp"

namespace glint {

/// What a tracker eats.
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
};

}  // namespace glint

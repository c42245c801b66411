// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>
#include <limits>
#include <span>
#include <tuple>
#include <vector>

namespace glint {

struct Scan;
enum class Feed;

/// Somebody's word for a target: where it is in the frame that this comes with.
struct Cue {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  double x = 0, y = 0;                  ///< [px]
  double vx = kUnknown, vy = kUnknown;  ///< [px/s]; NaN: not known
  /// Standard deviation of x and of y [px]; NaN: what the tracker takes a position to err by.
  double sigma = kUnknown;

  bool moves() const { return !std::isnan(vx); }
  double sigma_or(double otherwise) const { return std::isnan(sigma) ? otherwise : sigma; }

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.x, s.y, s.vx, s.vy, s.sigma);
  }
  void restored() const;
};

/// The cue itself. Throws std::invalid_argument, with what to give instead, unless the position is
/// finite, the velocity finite or unknown along both axes, and sigma above 0 or unknown.
const Cue& checked(const Cue& cue);

/// To where the targets are `seconds` [s] later; one whose velocity is not known stays.
void move_on(std::span<Cue> cues, double seconds);

/// What a tracker is told of its cues: those of scans that it cannot use wait, moved on, for one
/// that it can.
class TrackerCues {
 public:
  /// The cues to go with `scan`, none if a tracker that feeds on `feed` cannot use it; valid until
  /// the next call. Trackers of frames get those inside the frame. In a tracker's first scan
  /// velocities are not known: the time from frame to frame, which turns px/s into px/frame, is not
  /// known there.
  std::span<const Cue> due(std::span<const Cue> cues, const Scan& scan, Feed feed);

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.waiting_, s.time_, s.timed_);
  }

 private:
  std::vector<Cue> waiting_, due_;
  double time_ = 0;     // of the last scan [s]
  bool timed_ = false;  // the tracker has had a scan
};

}  // namespace glint

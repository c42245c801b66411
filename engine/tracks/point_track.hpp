// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <tuple>

#include "glint/engine/config.hpp"
#include "glint/engine/cue.hpp"
#include "glint/engine/filters/gaussian.hpp"
#include "glint/engine/tracks/step_clock.hpp"
#include "glint/engine/tracks/track_life.hpp"
#include "glint/engine/tracks/track_log.hpp"

namespace glint {

/// Settings of the life of tracks that all trackers of points share.
struct PointTrackConfig {
  bool initiate = true;
  double start_amplitude = 5;  ///< [sigma]
  double speed_max = 4;        ///< of a new target [px/time]
  double separation = 4;       ///< [px]
  int merge_scans = 8;
  TrackLifeConfig life;
};
void describe(FieldList& f, PointTrackConfig& c);
/// Throws ConfigError for settings that do not fit together.
void check(const PointTrackConfig& config);
/// Tracks that are started from known targets last, and there are no others.
void keep_to_known(PointTrackConfig& config);

/// A track of points, but for what it is followed with.
struct PointTrack {
  std::int64_t id = 0, first_frame = 0, last_seen = 0;
  TrackLife life;
  double amplitude = 0;   ///< [sigma]
  Gaussian<4> state{};    ///< [x vx y vy]
  bool reported = false;  ///< the log knows that it is confirmed
  int merged = 0;         ///< scans in a row that an older track was as near as `separation`

  Eigen::Vector2d position() const { return {state.mean(0), state.mean(2)}; }
  /// Lives, and is nearer to `place` than `separation` [px].
  bool near(const Eigen::Vector2d& place, double separation) const {
    return !life.over() && (position() - place).norm() < separation;
  }

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.id, s.first_frame, s.last_seen, s.life, s.amplitude, s.state, s.reported,
                    s.merged);
  }
};

/// A target that is told to a tracker, in the tracker's own time.
struct KnownTarget {
  Eigen::Vector4d state = Eigen::Vector4d::Zero();  ///< [x vx y vy]: [px], [px/time]
  /// Standard deviations [px], [px/time]; NaN: the tracker's own.
  double position_sd = Cue::kUnknown, velocity_sd = Cue::kUnknown;

  /// It is nearer to `place` than `separation` [px].
  bool near(const Eigen::Vector2d& place, double separation) const {
    return (Eigen::Vector2d(state(0), state(2)) - place).norm() < separation;
  }

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.state, s.position_sd, s.velocity_sd);
  }
};
/// `rate`: velocities of the tracker times this are px/s. One that is not known is any up to
/// `speed_max` [px/time] along each axis.
KnownTarget known_target(const Cue& cue, double rate, double speed_max);

/// Tells the log of a track at a scan: its point, that it is confirmed or has ended; a tentative
/// one that has ended never was. `rate`: velocities times this are px/s.
void report(PointTrack& track, const ModeProbability& probability, const StepTime& at, double rate,
            TrackLog& log);

}  // namespace glint

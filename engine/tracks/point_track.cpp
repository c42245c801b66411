// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/tracks/point_track.hpp"

#include <numbers>
#include <utility>

namespace glint {

void describe(FieldList& f, PointTrackConfig& c) {
  f("initiate", c.initiate, "start tracks from pairs of points that no track has");
  f("start_amplitude", c.start_amplitude, -1000, 1e6, "sigma",
    "least amplitude of such points, if they have any");
  f("speed_max", c.speed_max, 0, 1e9, "px/time", "of a new target");
  f("separation", c.separation, 0, 1e9, "px",
    "no new track this near to a living one; a tentative track ends if it comes this near");
  f("merge_scans", c.merge_scans, 0, 1000000, "scans",
    "of two confirmed tracks that near for so many scans in a row the younger ends; 0 is never");
  describe(f, c.life);
}

void check(const PointTrackConfig& config) { check(config.life); }

void keep_to_known(PointTrackConfig& config) {
  config.initiate = false;
  config.merge_scans = 0;
  config.life.halt_misses = 0, config.life.halt_existence = 0;
}

KnownTarget known_target(const Cue& cue, double rate, double speed_max) {
  KnownTarget target{{cue.x, 0, cue.y, 0}, cue.sigma};
  if (cue.moves()) {
    target.state(1) = cue.vx / rate, target.state(3) = cue.vy / rate;
  } else {
    target.velocity_sd = speed_max * std::numbers::inv_sqrt3;  // of a uniform one
  }
  return target;
}

void report(PointTrack& track, const ModeProbability& probability, const StepTime& at, double rate,
            TrackLog& log) {
  if (track.life.over() && !track.life.confirmed()) {
    log.drop(track.id, track.first_frame);
    return;
  }
  TrackPoint point;
  point.frame = at.frame, point.time = at.time, point.track_id = track.id;
  point.status = track.life.status();
  const auto& x = track.state.mean;
  point.x = x(0), point.y = x(2), point.vx = x(1) * rate, point.vy = x(3) * rate;
  point.intensity = track.amplitude, point.existence = track.life.existence();
  const auto& p = track.state.covariance;
  const StateCovariance covariance{p(0, 0), p(0, 2), p(2, 2), p(0, 1), p(0, 3),
                                   p(2, 1), p(2, 3), p(1, 1), p(1, 3), p(3, 3)};
  point.set_covariance(covariance.with_velocity_scaled(rate));
  point.mode_probability = probability;
  log.report(point);
  if (track.life.over()) log.drop(track.id, track.last_seen + 1);
  if (track.life.confirmed() && !std::exchange(track.reported, true)) {
    log.confirm(track.id, track.first_frame);
  }
}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>

#include "glint/engine/tracks/track_log.hpp"
#include "glint/frontends/capi/glint.h"

namespace glint {

/// A point as it goes to other languages; `tracker` is its tracker's index.
inline glint_track track_of(const TrackPoint& p, std::size_t tracker) {
  return {p.frame,
          p.time,
          p.track_id,
          static_cast<std::int32_t>(tracker),
          static_cast<std::int32_t>(p.status),
          p.x,
          p.y,
          p.vx,
          p.vy,
          p.intensity,
          p.existence,
          p.var_x,
          p.cov_xy,
          p.var_y,
          p.cov_x_vx,
          p.cov_x_vy,
          p.cov_y_vx,
          p.cov_y_vy,
          p.var_vx,
          p.cov_vx_vy,
          p.var_vy};
}

/// Back again; the model probabilities do not come along.
inline TrackPoint point_of(const glint_track& t) {
  TrackPoint p;
  p.frame = t.frame, p.time = t.time, p.track_id = t.track_id;
  p.status = static_cast<TrackStatus>(t.status);
  p.x = t.x, p.y = t.y, p.vx = t.vx, p.vy = t.vy;
  p.intensity = t.intensity, p.existence = t.existence;
  p.set_covariance({t.var_x, t.cov_xy, t.var_y, t.cov_x_vx, t.cov_x_vy, t.cov_y_vx, t.cov_y_vy,
                    t.var_vx, t.cov_vx_vy, t.var_vy});
  return p;
}

}  // namespace glint

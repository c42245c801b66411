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
          p.var_y};
}

}  // namespace glint

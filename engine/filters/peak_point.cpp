// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/filters/peak_point.hpp"

namespace glint {

TrackPoint point_of(const Peak& estimate, std::size_t modes, const StepTime& at) {
  TrackPoint point;
  point.frame = at.frame, point.time = at.time;
  point.x = estimate.x, point.y = estimate.y;
  point.vx = estimate.vx * at.velocity_scale, point.vy = estimate.vy * at.velocity_scale;
  point.intensity = estimate.intensity;
  point.var_x = estimate.var_x, point.cov_xy = estimate.cov_xy, point.var_y = estimate.var_y;
  for (std::size_t m = 0; m < modes; ++m) {
    point.mode_probability.push_back(estimate.mode_mass[m]);  // P-PHD (35)
  }
  return point;
}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/python/tables.hpp"

#include <algorithm>

#include "glint/frontends/capi/track_row.hpp"

namespace glint::python {
void register_rows() {
  PYBIND11_NUMPY_DTYPE(glint_track, frame, time, track_id, tracker, status, x, y, vx, vy, intensity,
                       existence, var_x, cov_xy, var_y, cov_x_vx, cov_x_vy, cov_y_vx, cov_y_vy,
                       var_vx, cov_vx_vy, var_vy);
  PYBIND11_NUMPY_DTYPE(TruthPoint, frame, track_id, x, y, vx, vy, intensity);
}

TrackArray track_array(std::span<const std::vector<TrackPoint>> trackers) {
  std::vector<glint_track> rows;
  for (std::size_t i = 0; i < trackers.size(); ++i) {
    for (const TrackPoint& point : trackers[i]) rows.push_back(track_of(point, i));
  }
  return array_of(rows);
}

TrackArray track_array(std::span<const Track> tracks) {
  std::vector<glint_track> rows;
  rows.reserve(tracks.size());
  for (const Track& track : tracks) {
    rows.push_back(track_of(track, static_cast<std::size_t>(track.tracker)));
  }
  return array_of(rows);
}

TruthArray truth_array(const std::vector<TruthPoint>& truth) { return array_of(truth); }

std::vector<TrackPoint> track_points(const TrackArray& rows) {
  const auto all = rows.unchecked<1>();
  std::vector<TrackPoint> points;
  for (py::ssize_t i = 0; i < all.shape(0); ++i) points.push_back(point_of(all(i)));
  return points;
}

std::vector<TruthPoint> truth_points(const TruthArray& rows) {
  const auto all = rows.unchecked<1>();
  std::vector<TruthPoint> points;
  for (py::ssize_t i = 0; i < all.shape(0); ++i) points.push_back(all(i));
  return points;
}

}  // namespace glint::python

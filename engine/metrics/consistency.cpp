// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/metrics/consistency.hpp"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "glint/engine/metrics/by_frame.hpp"

namespace glint {
namespace {

Eigen::Matrix4d matrix_of(const StateCovariance& c) {
  Eigen::Matrix4d p;
  p << c.var_x, c.cov_xy, c.cov_x_vx, c.cov_x_vy,     //
      c.cov_xy, c.var_y, c.cov_y_vx, c.cov_y_vy,      //
      c.cov_x_vx, c.cov_y_vx, c.var_vx, c.cov_vx_vy,  //
      c.cov_x_vy, c.cov_y_vy, c.cov_vx_vy, c.var_vy;
  return p;
}

/// Of the first N of x, y, vx, vy.
template <int N>
void add_nees(const TruthPoint& truth, const TrackPoint& track, PointSum& to) {
  const Eigen::Vector4d error(track.x - truth.x, track.y - truth.y, track.vx - truth.vx,
                              track.vy - truth.vy);
  const Eigen::Vector<double, N> e = error.head<N>();
  const Eigen::Matrix<double, N, N> p = matrix_of(track).topLeftCorner<N, N>();
  if (!e.allFinite() || !p.allFinite()) return;
  const Eigen::LLT<Eigen::Matrix<double, N, N>> root(p);
  if (root.info() != Eigen::Success) return;
  to.sum += e.dot(root.solve(e)), ++to.points;
}

const TruthPoint* nearest(std::span<const TruthPoint> truth, const TrackPoint& track,
                          double reach) {
  const TruthPoint* best = nullptr;
  for (const TruthPoint& t : truth) {
    const double distance = std::hypot(t.x - track.x, t.y - track.y);
    if (distance <= reach) reach = distance, best = &t;
  }
  return best;
}

void add_point(std::span<const TruthPoint> truth, const TrackPoint& track, double reach,
               Consistency& to) {
  const TruthPoint* target = nearest(truth, track, reach);
  if (!std::isnan(track.existence)) {
    const double error = track.existence - (target != nullptr ? 1 : 0);
    to.existence_error.sum += error * error, ++to.existence_error.points;
    if (target != nullptr) ++to.real;
  }
  if (target == nullptr || track.status != TrackStatus::confirmed) return;
  add_nees<2>(*target, track, to.position_nees);
  add_nees<4>(*target, track, to.state_nees);
}

}  // namespace

double Consistency::brier_of_base_rate() const {
  const double rate = static_cast<double>(real) / static_cast<double>(existence_error.points);
  return rate * (1 - rate);
}

Consistency consistency(std::span<const TruthPoint> truth, std::span<const TrackPoint> tracks,
                        double reach, std::optional<std::int64_t> frames) {
  Consistency result;
  const std::int64_t scored = frames.value_or(frame_count(tracks));
  const auto truth_by_frame = by_frame(truth, scored);
  const auto tracks_by_frame = by_frame(tracks, scored);
  for (std::size_t f = 0; f < tracks_by_frame.size(); ++f) {
    for (const TrackPoint& track : tracks_by_frame[f]) {
      add_point(truth_by_frame[f], track, reach, result);
    }
  }
  return result;
}

}  // namespace glint

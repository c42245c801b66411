// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace glint {

enum class TrackStatus { tentative, confirmed, halted };

/// A track at one frame. Unknown values are NaN. Position [px], velocity [px/s], intensity
/// [sigmas].
struct TrackPoint {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  std::int64_t frame = 0;
  double time = 0;  ///< [s]
  std::int64_t track_id = 0;
  TrackStatus status = TrackStatus::tentative;
  double x = kUnknown, y = kUnknown, vx = kUnknown, vy = kUnknown;
  double intensity = kUnknown, existence = kUnknown;
  double var_x = kUnknown, cov_xy = kUnknown, var_y = kUnknown;  ///< [px^2]
  std::vector<double> mode_probability;  ///< in the order of TrackLog::mode_names()
};

/// All that a tracker has said: per frame and track, online and as revised later. Order is by
/// frame, then by track id; it does not depend on the order of the calls.
class TrackLog {
 public:
  /// Names of the motion models, for the p_<model> columns.
  void set_mode_names(std::vector<std::string> names) { mode_names_ = std::move(names); }
  const std::vector<std::string>& mode_names() const { return mode_names_; }

  /// Says what is known now of a track at `point.frame`; the online record and the revised one.
  void report(TrackPoint point);
  /// Replaces or adds a point of an earlier frame in the revised record only.
  void revise(TrackPoint point);
  /// Marks the track's points from `frame` on as confirmed in the revised record.
  void confirm(std::int64_t track_id, std::int64_t frame);
  /// Removes the track's points from `frame` on in the revised record.
  void drop(std::int64_t track_id, std::int64_t frame);

  std::vector<TrackPoint> online() const;   ///< as reported at the time
  std::vector<TrackPoint> revised() const;  ///< with all later corrections
  /// What was reported online at `frame`, by track id.
  std::vector<TrackPoint> at(std::int64_t frame) const;
  /// Bytes that a run is compared by; equal logs give equal text.
  std::string text() const;

 private:
  using Key = std::pair<std::int64_t, std::int64_t>;  // frame, track
  std::map<Key, TrackPoint> online_, revised_;
  std::vector<std::string> mode_names_;
};

}  // namespace glint

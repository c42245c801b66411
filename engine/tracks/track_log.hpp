// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "glint/engine/filters/mode_probability.hpp"
#include "glint/engine/state/bytes.hpp"
#include "glint/engine/tracks/state_covariance.hpp"

namespace glint {

enum class TrackStatus { tentative, confirmed, halted };

/// A track at one frame. Unknown values are NaN. Position [px], velocity [px/s], intensity
/// [sigmas].
struct TrackPoint : StateCovariance {
  std::int64_t frame = 0;
  double time = 0;  ///< [s]
  std::int64_t track_id = 0;
  TrackStatus status = TrackStatus::tentative;
  double x = kUnknown, y = kUnknown, vx = kUnknown, vy = kUnknown;
  double intensity = kUnknown, existence = kUnknown;
  ModeProbability mode_probability;  ///< in the order of TrackLog::mode_names()

  template <class Self>
  static auto fields(Self& s) {
    return std::tuple_cat(std::tie(s.frame, s.time, s.track_id, s.status, s.x, s.y, s.vx, s.vy,
                                   s.intensity, s.existence),
                          StateCovariance::fields(s), std::tie(s.mode_probability));
  }
  void set_covariance(const StateCovariance& c) { static_cast<StateCovariance&>(*this) = c; }
  void restored() const {
    require_bytes(status >= TrackStatus::tentative && status <= TrackStatus::halted,
                  "a track has no such status");
  }
};

/// Track points by frame, then by track id. Points stay where they were put and each frame chains
/// its own by index, so that adding one, early or late, moves no other and allocates only as the
/// table grows; the room of removed and forgotten ones is used again.
class TrackTable {
 public:
  void reserve(std::size_t points);
  /// Adds the point, or replaces the one of that frame and track.
  void put(const TrackPoint& point);
  /// Removes the track's points from `frame` on.
  void remove(std::int64_t track_id, std::int64_t frame);
  /// Removes the points before `frame`, and keeps none that come there later.
  void forget(std::int64_t frame);
  /// Tentative points of the track from `frame` on become confirmed.
  void confirm(std::int64_t track_id, std::int64_t frame, double existence);
  /// Calls f(point) for the points of `frame`, by track id.
  template <class F>
  void at(std::int64_t frame, F&& f) const {
    const std::size_t i = lower_bound(frame);
    if (i < frames_.size() && frames_[i].frame == frame) visit(i, f);
  }
  /// Calls f(point) for every point, by frame, then by track id.
  template <class F>
  void each(F&& f) const {
    for (std::size_t i = 0; i < frames_.size(); ++i) visit(i, f);
  }
  /// For checkpoints: the points alone, not where they lie.
  void put_to(ByteWriter& to) const;
  void take_from(ByteReader& from);

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  struct FrameChain {
    std::int64_t frame;
    std::size_t first = kNone, last = kNone;
  };
  struct Node {
    TrackPoint point;
    std::size_t next;
  };

  template <class F>
  void visit(std::size_t frame_index, F& f) const {
    for (std::size_t n = frames_[frame_index].first; n != kNone; n = nodes_[n].next) {
      f(nodes_[n].point);
    }
  }
  std::size_t lower_bound(std::int64_t frame) const;
  /// Where a track stands in a chain: its node, or none, and the node before that place.
  struct Place {
    std::size_t before, node;
  };
  Place find(const FrameChain& chain, std::int64_t track_id) const;
  std::size_t& link_after(FrameChain& chain, std::size_t before) {
    return before == kNone ? chain.first : nodes_[before].next;
  }

  std::size_t take_node(const TrackPoint& point);
  void free_node(std::size_t node) { nodes_[node].next = std::exchange(free_, node); }

  std::vector<FrameChain> frames_;  // by frame
  std::vector<Node> nodes_;
  std::size_t free_ = kNone;  // chain of nodes that hold no point
  std::int64_t forgotten_ = std::numeric_limits<std::int64_t>::min();
};

/// All that a tracker has reported: per frame and track, online and as revised later. Order is by
/// frame, then by track id; it does not depend on the order of the calls.
class TrackLog {
 public:
  /// Names of the motion models, for the p_<model> columns. Throws std::invalid_argument for more
  /// than kMostModes.
  void set_mode_names(std::vector<std::string> names);
  const std::vector<std::string>& mode_names() const { return mode_names_; }
  /// Makes room: no call allocates until there are more points than this.
  void reserve(std::size_t points);

  /// Says what is known now of a track at `point.frame`; the online record and the revised one.
  void report(const TrackPoint& point);
  /// Replaces or adds a point of an earlier frame in the revised record only.
  void revise(const TrackPoint& point) { revised_.put(point); }
  /// Marks the track's tentative points from `frame` on as confirmed in the revised record.
  /// Those that state an existence below `existence` stay what they are.
  void confirm(std::int64_t track_id, std::int64_t frame, double existence = 0) {
    revised_.confirm(track_id, frame, existence);
  }
  /// Removes the track's points from `frame` on in the revised record.
  void drop(std::int64_t track_id, std::int64_t frame) { revised_.remove(track_id, frame); }

  /// Removes the points of the frames before `frame`; what is reported of them later is not kept.
  void forget(std::int64_t frame) {
    online_.forget(frame);
    revised_.forget(frame);
  }

  std::vector<TrackPoint> online() const;   ///< as reported at the time
  std::vector<TrackPoint> revised() const;  ///< with all later corrections
  /// What was reported online at `frame`, by track id.
  std::vector<TrackPoint> at(std::int64_t frame) const;
  /// The same into `points`, which is replaced; its capacity is used again.
  void at(std::int64_t frame, std::vector<TrackPoint>& points) const;
  /// Bytes that a run is compared by; equal logs give equal text.
  std::string text() const;

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.online_, s.revised_, s.mode_names_);
  }
  void restored() const {
    require_bytes(mode_names_.size() <= kMostModes, "a log has too many models");
  }

 private:
  TrackTable online_, revised_;
  std::vector<std::string> mode_names_;
};

}  // namespace glint

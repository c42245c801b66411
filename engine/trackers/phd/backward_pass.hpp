// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <tuple>
#include <vector>

#include "glint/engine/trackers/phd/followed_targets.hpp"

namespace glint {

/// Follows a newly confirmed target back to where it came from. P-PHD (25)-(27), with F^-1 and the
/// Markov chain reversed. It starts from the particles at confirmation: those at detection were
/// selected because they fit the frames just before it, noise included.
class BackwardPass {
 public:
  /// Goes at most `frames` frames back beyond the detection; 0 = no backward pass.
  BackwardPass(const FollowedTargetsConfig& config, const MotionConfig& motion, int frames,
               const Device& device, std::uint64_t seed);
  void set_appearance(const TargetAppearance& appearance) { filters_.set_appearance(appearance); }

  /// Where a track is in a frame [px].
  struct Position {
    std::uint32_t id;
    double x, y;
    template <class Self>
    static auto fields(Self& s) {
      return std::tie(s.id, s.x, s.y);
    }
  };
  /// A track that is to be traced: the frame of its detection, and the one that its particles are
  /// of.
  struct Start {
    std::uint32_t id;
    std::int64_t detected, now;
  };

  /// Stores a frame and where all tracks are in it; call it once they have been reported.
  void remember(const Frame& z, const StepTime& at, std::span<const Position> tracks);
  /// Adds the points of target `t` before its detection to the revised record, as far as the target
  /// is likely to have been there already: that probability, given all frames looked at, is their
  /// existence. Looks until `halt_misses` misses in a row or nearer than `separation` to another
  /// track.
  void trace(const TargetFilters& targets, std::size_t t, const Start& start, TrackLog& log);
  /// The same for a target that is a cluster of particles.
  void trace(const Cluster& cluster, const Start& start, TrackLog& log);

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.filters_, s.past_, s.next_);
  }
  void restored() const;

 private:
  struct Past {
    Frame z;
    StepTime at;
    std::vector<Position> tracks;
    template <class Self>
    static auto fields(Self& s) {
      return std::tie(s.z, s.at, s.tracks);
    }
  };
  /// A point before the detection, and how likely the target is to have appeared in its frame, over
  /// having appeared when it was detected.
  struct Earlier {
    TrackPoint point;
    double log_weight;
  };
  /// From the frame before the detection on, into the past.
  std::vector<Earlier> earlier_points(const Start& start);
  /// Traces the one target in filters_.
  void trace(const Start& start, TrackLog& log);
  bool near_another(const Past& past, const Peak& estimate, std::uint32_t id) const;

  FollowedTargetsConfig config_;
  double survival_;
  std::size_t modes_;
  TargetFilters filters_;
  std::size_t capacity_;
  std::vector<Past> past_;  // a ring of `capacity_` frames
  std::size_t next_ = 0;    // index of the next frame in it
};

}  // namespace glint

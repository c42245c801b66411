// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <tuple>
#include <vector>

#include "glint/engine/trackers/phd/followed_targets.hpp"

namespace glint {

/// Follows a newly confirmed target back to where it came from. P-PHD (25)-(27), with F^-1 and the
/// Markov chain reversed; from the cloud at confirmation, not at detection: that one was chosen for
/// fitting the very frames before detection that are to be judged.
class BackwardPass {
 public:
  /// Goes at most `frames` back; 0 = never.
  BackwardPass(const FollowedTargetsConfig& config, const MotionBank& bank, int frames,
               const Device& device, std::uint64_t seed);
  void set_appearance(const TargetAppearance& appearance) { filters_.set_appearance(appearance); }

  /// Takes a frame and where the targets were in it, after the targets have been followed.
  void remember(const Frame& z, const StepTime& at, std::span<const FollowedTarget> targets);
  /// Adds the points before detection of target `t`, confirmed in frame `now`, to the revised
  /// record. Ends where the target is missed as often as halts a track, or comes upon another
  /// track.
  void trace(const FollowedTargets& targets, std::size_t t, std::int64_t now, TrackLog& log);

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.filters_, s.past_, s.next_);
  }
  void restored() const;

 private:
  struct Position {
    std::uint32_t id;
    double x, y;
    template <class Self>
    static auto fields(Self& s) {
      return std::tie(s.id, s.x, s.y);
    }
  };
  struct Past {
    Frame z;
    StepTime at;
    std::vector<Position> targets;
    template <class Self>
    static auto fields(Self& s) {
      return std::tie(s.z, s.at, s.targets);
    }
  };
  bool meets_another(const Past& past, const Peak& estimate, std::uint32_t id) const;

  FollowedTargetsConfig config_;
  std::size_t modes_;
  TargetFilters filters_;
  std::size_t capacity_;
  std::vector<Past> past_;  ///< a ring
  std::size_t next_ = 0;    ///< where the next frame goes
};

}  // namespace glint

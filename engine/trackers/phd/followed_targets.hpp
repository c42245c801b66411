// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "glint/engine/config.hpp"
#include "glint/engine/scan.hpp"
#include "glint/engine/trackers/phd/peaks.hpp"
#include "glint/engine/trackers/phd/target_filters.hpp"
#include "glint/engine/tracks/track_log.hpp"

namespace glint {

/// When a target that is being followed is still there.
enum class LifeRule {
  existence,        ///< hit while n = W L / (1 + W L) holds, W = e n_{k-1}. P-PHD (14), (19)
  likelihood_ratio  ///< miss while S = min(0, S + ln L) < 0, ended at ln P_M: Boers and Driessen's
                    ///< test
};

struct FollowedTargetsConfig {
  LifeRule rule = LifeRule::existence;
  int particles = 1500;    ///< a target
  double survival = 0.99;  ///< from frame to frame
  double existence = 0.5;  ///< least n of a hit
  int confirm_hits = 5;    ///< hits to be confirmed; the detection is the first
  int halt_misses = 3;     ///< misses in a row that end a confirmed track; a tentative one ends on
                           ///< its first
  double miss = 0.05;      ///< P_M of the likelihood ratio test
  double separation = 6;   ///< [px]: none is detected this near to a track; of two the younger dies
};

/// A target with a track.
struct FollowedTarget {
  std::uint32_t id = 0;
  double existence = 1;  ///< n, or e^S
  int hits = 1, misses = 0;
  bool confirmed = false, ended = false;
  std::int64_t detected = 0;      ///< frame k0
  std::int64_t first_missed = 0;  ///< of the present row of misses
  Peak estimate;                  ///< velocity a frame

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.id, s.existence, s.hits, s.misses, s.confirmed, s.ended, s.detected,
                    s.first_missed, s.estimate);
  }
  void restored() const;
};

/// Tracks from their detection to their end, each with a particle filter of its own.
class FollowedTargets {
 public:
  FollowedTargets(const FollowedTargetsConfig& config, const MotionBank& bank, const Device& device,
                  std::uint64_t seed);
  void set_appearance(const TargetAppearance& appearance) { filters_.set_appearance(appearance); }

  /// Moves all targets to the frame `z`, weighs them, updates which of them are still there, and
  /// reports them. Those that end lose the points of their last misses.
  void follow(const Frame& z, const StepTime& at, TrackLog& log);
  /// A track for a new target unless one is within the separation, then false.
  bool detect(const Peak& peak, const Particles& particles, std::span<const std::uint32_t> members,
              const StepTime& at, TrackLog& log);

  std::span<const FollowedTarget> targets() const { return targets_; }  ///< by rising id
  /// Tracks confirmed by the last follow() or detect(): indices into targets().
  std::span<const std::size_t> confirmed_now() const { return confirmed_now_; }
  const TargetFilters& filters() const { return filters_; }  ///< same indices
  /// Boxes of 2 half_width + 1 pixels around all targets.
  void boxes(int half_width, std::vector<Box>& boxes) const;

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.filters_, s.targets_, s.next_id_);
  }
  void restored() const;

 private:
  void update_life(FollowedTarget& target, const TargetUpdate& update, std::int64_t frame) const;
  void end_duplicates();
  void report(FollowedTarget& target, const StepTime& at, TrackLog& log);
  void forget_ended();

  FollowedTargetsConfig config_;
  std::size_t modes_;
  TargetFilters filters_;
  std::vector<FollowedTarget> targets_;
  std::vector<std::size_t> confirmed_now_;
  std::uint32_t next_id_ = 1;
};

}  // namespace glint

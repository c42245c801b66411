// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "glint/engine/config.hpp"
#include "glint/engine/cue.hpp"
#include "glint/engine/scan.hpp"
#include "glint/engine/trackers/phd/peaks.hpp"
#include "glint/engine/trackers/phd/target_filters.hpp"
#include "glint/engine/tracks/track_log.hpp"

namespace glint {

/// When a frame counts as a hit or a miss of a target, and when its track ends. L is the mean
/// likelihood ratio of its particles in the frame.
enum class LifeRule {
  existence,        ///< existence probability r_k, see bernoulli_update(): a hit if it is at least
                    ///< `existence`
  likelihood_ratio  ///< S_k = min(0, S_{k-1} + ln L): a hit if S_k = 0, the end if S_k <= ln P_M.
                    ///< Boers and Driessen's test
};

/// Settings of the targets that have a track.
struct FollowedTargetsConfig {
  LifeRule rule = LifeRule::existence;
  int target_particles = 1500;     ///< of each target
  double existence = 0.5;          ///< least r_k of a hit
  int confirm_hits = 5;            ///< hits to be confirmed; the detection is the first
  int halt_misses = 3;             ///< misses in a row that end a confirmed track (a tentative one
                                   ///< ends on its first); rule `existence` only
  double miss_probability = 0.05;  ///< P_M; rule `likelihood_ratio` only
  double separation = 6;           ///< no target is detected this near to a track, and of two
                                   ///< tracks this near one ends [px]
};

/// Lists `separation` alone.
void describe_separation(FieldList& f, FollowedTargetsConfig& c);

/// A target with a track.
struct FollowedTarget {
  std::uint32_t id = 0;
  double existence = 1;  ///< r_k, see bernoulli_update()
  int hits = 1, misses = 0;
  bool confirmed = false, ended = false;
  bool cued = false;          ///< somebody has said that it is there
  std::int64_t detected = 0;  ///< frame of the detection, k0
  /// Likelihood of having lived till now over that of having ended when it was likeliest, at
  /// most 1; e^S_k of the ratio test, which knows no survival.
  double support = 1;
  std::int64_t first_missed = 0;  ///< frame after that one
  bool recovered = false;         ///< by this frame, from support below 1
  Peak estimate;                  ///< velocity in [px/frame]

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.id, s.existence, s.hits, s.misses, s.confirmed, s.ended, s.cued, s.detected,
                    s.support, s.first_missed, s.estimate);
  }
  void restored() const;
};

/// The targets that have a track, from detection to the end of the track, each with a particle
/// filter of its own. P-PHD section 4.2
class FollowedTargets {
 public:
  FollowedTargets(const FollowedTargetsConfig& config, const MotionConfig& motion,
                  const Device& device, std::uint64_t seed);
  void set_appearance(const TargetAppearance& appearance) { filters_.set_appearance(appearance); }

  /// Predicts and updates all targets by the frame `z`, counts hits and misses, ends tracks, and
  /// reports to the log. A track that ends loses its points after the frame that is the likeliest
  /// for its end there. Each of the `cues` is a new target, confirmed from the first, or confirms
  /// the one that is followed within `separation` of it.
  void follow(const Frame& z, const StepTime& at, TrackLog& log, std::span<const Cue> cues = {});
  /// Starts a track from a cluster of particles. False, and no track, if another is nearer than
  /// `separation`.
  bool detect(const Cluster& cluster, const StepTime& at, TrackLog& log);

  std::span<const FollowedTarget> targets() const { return targets_; }  ///< by rising id
  /// Tracks confirmed by the last follow() or detect(): indices into targets().
  std::span<const std::size_t> confirmed_now() const { return confirmed_now_; }
  const TargetFilters& filters() const { return filters_; }  ///< same indices

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.filters_, s.targets_, s.next_id_);
  }
  void restored() const;

 private:
  void start(const Cue& cue, const StepTime& at, TrackLog& log);
  void update_life(FollowedTarget& target, const TargetUpdate& update, const StepTime& at) const;
  void note_support(FollowedTarget& target, double survival, double ratio,
                    std::int64_t frame) const;
  void end_duplicates();
  void report(FollowedTarget& target, const StepTime& at, TrackLog& log);
  void remove_ended();
  void confirm(std::size_t t, TrackLog& log);

  FollowedTargetsConfig config_;
  double survival_, speed_max_;
  std::size_t modes_;
  TargetFilters filters_;
  std::vector<FollowedTarget> targets_;
  std::vector<std::size_t> confirmed_now_;
  std::uint32_t next_id_ = 1;
};

}  // namespace glint

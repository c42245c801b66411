// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "glint/engine/config.hpp"
#include "glint/engine/cue.hpp"
#include "glint/engine/trackers/phd/peaks.hpp"
#include "glint/engine/tracks/track_log.hpp"

namespace glint {

/// Settings of identities.
struct IdentityConfig {
  int confirm_hits = 4;   ///< frames with a peak before a track is confirmed
  int halt_misses = 3;    ///< frames in a row without one that end it
  double separation = 6;  ///< no new track begins nearer than this to another [px]
  double reacquire = 4;   ///< a peak without a label takes the identity of a lost track that is
                          ///< predicted nearer than this [px]
};
void describe(FieldList& f, IdentityConfig& c);

/// Gives peaks identities that persist: a peak takes the label that most of its particles carry,
/// and its particles take its label, so that resampling carries the identity on.
class Identities {
 public:
  /// `survival`: probability that a target lives on to the next frame.
  Identities(const IdentityConfig& config, double survival)
      : config_(config), survival_(survival) {}

  /// Labels the members of each peak in `particles` and reports the tracks of this frame. Peaks
  /// are sorted by falling mass: of two that carry one label the heavier takes it. `faint` are
  /// those below the least mass of a target: what is left of tracks that have no peak. These
  /// tracks have missed the frame; they are reported as tentative.
  void assign(std::span<const Peak> peaks, std::span<const Peak> faint,
              std::span<const std::uint32_t> members, Particles& particles, const StepTime& at,
              std::size_t modes, TrackLog& log);

  /// Before assign(): a confirmed track begins where a cue says, and particles that carry its id
  /// are its own. A track that is expected within `separation` there is confirmed by its next peak
  /// instead, and none begins: 0.
  std::uint32_t start(const Cue& cue, const StepTime& at);

  /// A track that the last assign() confirmed.
  struct Confirmed {
    std::uint32_t id;
    std::int64_t detected;  ///< frame of its first peak
    std::size_t peak;       ///< its peak now, by index
  };
  std::span<const Confirmed> confirmed_now() const { return confirmed_now_; }
  /// Calls f(id, x, y) for every track that has a peak in the present frame.
  template <class F>
  void each_seen(F&& f) const {
    for (const Track& t : tracks_) {
      if (t.seen) f(t.id, t.x, t.y);
    }
  }

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.tracks_, s.next_id_);
  }

 private:
  struct Track {
    std::uint32_t id = 0;
    std::int64_t detected = 0;  // frame of its first peak
    int hits = 0, misses = 0;
    bool seen = false;      // has a peak in the present frame
    double x = 0, y = 0;    // predicted to the present frame, or that of its peak there [px]
    double vx = 0, vy = 0;  // [px/frame]
    double mass = 0;        // of its particles in the last frame; 0 if none were found
    double existence = 0;   // probability
    template <class Self>
    static auto fields(Self& s) {
      return std::tie(s.id, s.detected, s.hits, s.misses, s.seen, s.x, s.y, s.vx, s.vy, s.mass,
                      s.existence);
    }
  };
  Track* labelled(const Peak& peak, std::span<const std::uint32_t> members,
                  const Particles& particles);
  Track* lost_near(const Peak& peak);
  bool near_seen(const Peak& peak) const;
  void see(Track& track, const Peak& peak, double step) const;
  void weigh(Track& track, const Peak& peak, double step) const;
  void report(const Track& track, const Peak& peak, std::size_t modes, const StepTime& at,
              TrackLog& log) const;
  void pass_over(std::span<const Peak> faint, std::span<const std::uint32_t> members,
                 const Particles& particles, const StepTime& at, std::size_t modes, TrackLog& log);
  void halt_missing(const StepTime& at, TrackLog& log);

  IdentityConfig config_;
  double survival_;
  std::vector<Track> tracks_;  // by rising id
  std::vector<std::pair<std::uint32_t, double>> votes_;
  std::vector<std::uint32_t> assigned_;  // by peak: its track, 0 = none
  std::vector<std::uint32_t> left_;      // tracks of faint peaks
  std::vector<Confirmed> confirmed_now_;
  std::uint32_t next_id_ = 1;
};

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "glint/engine/trackers/phd/peaks.hpp"
#include "glint/engine/tracks/track_log.hpp"

namespace glint {

struct IdentityConfig {
  int confirm_hits = 4;   ///< frames with a peak before a track is confirmed
  int halt_misses = 3;    ///< frames without one before it ends
  double separation = 6;  ///< a new track must be this far from a live one [px]
  double reacquire = 4;   ///< a peak without a label takes a lost track's identity within this [px]
};

/// Gives peaks identities that persist: a peak takes the label that most of its particles carry,
/// and its particles take its label; so identity travels with the cloud through resampling.
class Identities {
 public:
  explicit Identities(const IdentityConfig& config) : config_(config) {}

  /// Labels the members of each peak in `particles` and reports the tracks of this frame. Peaks
  /// come by falling mass: of two that claim one label the heavier has it. `step` is the number of
  /// frames since the last call; `velocity_scale` takes px a frame to px/s.
  void assign(std::span<const Peak> peaks, std::span<const std::uint32_t> members,
              Particles& particles, std::int64_t frame, double time, double step,
              double velocity_scale, std::size_t modes, TrackLog& log);

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.tracks_, s.next_id_);
  }

 private:
  struct Track {
    std::uint32_t id = 0;
    int hits = 0, misses = 0;
    bool seen = false;
    double x = 0, y = 0, vx = 0,
           vy = 0;  ///< predicted or seen at the present frame; velocity a frame
    template <class Self>
    static auto fields(Self& s) {
      return std::tie(s.id, s.hits, s.misses, s.seen, s.x, s.y, s.vx, s.vy);
    }
  };
  Track* claim(const Peak& peak, std::span<const std::uint32_t> members,
               const Particles& particles);
  Track* lost_near(const Peak& peak);
  bool crowded(const Peak& peak) const;
  void halt_missing(std::int64_t frame, double time, double velocity_scale, TrackLog& log);

  IdentityConfig config_;
  std::vector<Track> tracks_;  ///< by rising id
  std::vector<std::pair<std::uint32_t, double>> votes_;
  std::vector<std::uint32_t> claimed_;  ///< by peak: its track, 0 = none
  std::uint32_t next_id_ = 1;
};

}  // namespace glint

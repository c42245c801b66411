// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "glint/engine/frames/target_appearance.hpp"
#include "glint/engine/trackers/viterbi/path_window.hpp"
#include "glint/engine/tracks/step_clock.hpp"
#include "glint/engine/tracks/tracker.hpp"

namespace glint {

/// Settings of `viterbi`.
struct ViterbiConfig : AppearanceConfig {
  ViterbiConfig() { snr_low = 8, snr_high = 14; }
  double speed_max = 4;         ///< [px/frame]
  double acceleration_max = 2;  ///< [px/frame^2]
  int window = 8;               ///< scans
  double threshold = 30;        ///< V_T, on the sum of log-likelihood ratios
  double separation = 3;        ///< [px]
  int common_frames = 3;
  int settled_frames = 4;
  int halt_frames = 4;
};
void describe(FieldList& f, ViterbiConfig& c);

/// Viterbi-like dynamic programming track-before-detect, what P-PHD section 5.3 compares with: the
/// best paths through a sliding window of log-likelihood ratio maps, stitched to tracks. Tracks are
/// reported from the scan on whose window shows them, and filled in and corrected backwards.
class Viterbi : public TrackerOf<Viterbi> {
 public:
  /// Throws ConfigError for settings that do not fit together.
  Viterbi(const ViterbiConfig& config, const Device& device, std::uint64_t seed);
  Feed feed() const override { return Feed::frames; }
  void step(const Scan& scan, TrackLog& log) override;
  std::vector<std::string> notes() const override { return {appearance_.note()}; }

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.appearance_, s.window_, s.clock_, s.times_, s.tracks_, s.next_id_);
  }
  void restored() const;

 private:
  /// A track where the window still shows it. One that is halted takes the paths that come near
  /// it until its last point has left the window, and is not reported any more.
  struct Track {
    std::int64_t id = 0;
    std::vector<TrackPoint> points;  ///< by frame
    bool seen = true, halted = false;
    template <class Self>
    static auto fields(Self& s) {
      return std::tie(s.id, s.points, s.seen, s.halted);
    }
  };

  void score(const Frame& z, double step, std::span<const Cue> cues);
  void stitch(const WindowPath& path, TrackLog& log);
  double distance(const Track& track, const WindowPath& path) const;
  Track& owner(const WindowPath& path);
  TrackPoint point_of(const WindowPath& path, std::size_t k, std::int64_t id) const;
  void halt(Track& track, TrackLog& log) const;
  void forget(TrackLog& log);

  ViterbiConfig config_;
  Device device_;
  TargetAppearance appearance_;
  PathWindow window_;
  StepClock clock_;
  std::vector<StepTime> times_;  ///< of the window's stages
  std::vector<Track> tracks_;    ///< by rising id
  std::int64_t next_id_ = 1;
};

}  // namespace glint

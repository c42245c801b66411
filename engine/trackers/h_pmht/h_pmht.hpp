// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <tuple>
#include <vector>

#include "glint/engine/trackers/h_pmht/frame_pair_starts.hpp"
#include "glint/engine/trackers/h_pmht/h_pmht_config.hpp"
#include "glint/engine/trackers/h_pmht/hpmht_batch.hpp"
#include "glint/engine/tracks/tracker.hpp"
#include "glint/kernels/core/device.hpp"
#include "glint/kernels/core/point_spread.hpp"

namespace glint {

/// Histogram probabilistic multi-hypothesis tracker, P-HPMHT, over a sliding batch of scans, with
/// targets that come and go (docs/trackers/h-pmht.md). Tracks enter the log when they are
/// confirmed; their points are revised as long as they are in the batch.
class HPmht : public TrackerOf<HPmht> {
 public:
  /// Throws ConfigError for settings that do not fit together.
  HPmht(const HPmhtConfig& config, const Device& device, std::uint64_t seed);
  Feed feed() const override { return Feed::frames; }
  /// A confirmed track that is at (x, y) [px] with velocity (vx, vy) [px/frame] at the next scan
  /// with a frame; the scans after that move it.
  void start(double x, double y, double vx, double vy) { starts_.push_back({x, y, vx, vy}); }
  void step(const Scan& scan, TrackLog& log) override;

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.batch_, s.window_, s.scans_, s.targets_, s.lives_, s.starts_, s.next_id_,
                    s.pairs_, s.last_frame_, s.last_time_);
  }
  void restored();

 private:
  struct Start {
    double x, y, vx, vy;  ///< [px], [px/frame]
    /// Variances [px^2], [px^2/frame^2]; 0: those of the settings.
    double position_variance = 0, velocity_variance = 0;
    template <class Self>
    static auto fields(Self& s) {
      return std::tie(s.x, s.y, s.vx, s.vy, s.position_variance, s.velocity_variance);
    }
  };
  struct WindowScan {
    Frame frame;  ///< keeps the batch's view alive
    std::int64_t number;
    double time;
    double rate;  ///< [frames/s]
    template <class Self>
    static auto fields(Self& s) {
      return std::tie(s.frame, s.number, s.time, s.rate);
    }
  };
  struct Life {
    std::int64_t id = 0;  ///< 0 until confirmed
    bool over = false;
    template <class Self>
    static auto fields(Self& s) {
      return std::tie(s.id, s.over);
    }
  };

  void advance(const Scan& scan, const Frame& frame);
  CellRule rule_of(const Frame& frame);
  /// A target at `at` one step before scan `first`.
  BatchTarget target_at(const Start& at, std::size_t first, double proportion) const;
  void take_cues(const Scan& scan);
  void weigh_existence();
  void add_starts(TrackLog& log);
  void add_candidates(const Scan& scan);
  bool crowded(double x, double y) const;
  bool follow_one_target(std::size_t older, std::size_t younger) const;
  void end_duplicates();
  double mean_count(const BatchTarget& target, int frames) const;
  void update_lives();
  TrackPoint point_of(std::size_t k, std::size_t t) const;
  void report(TrackLog& log);
  void remove_ended(TrackLog& log);
  const BatchState& last_state(const BatchTarget& target) const {
    return target.states[scans_.size() - 1];
  }

  HPmhtConfig config_;
  Device device_;
  std::vector<double> intensities_;  // that existence reckons with [noise sigmas]
  HPmhtBatch batch_;
  std::vector<WindowScan> window_;  // oldest first
  std::vector<BatchScan> scans_;    // the same scans as the batch sees them
  std::vector<BatchTarget> targets_;
  std::vector<Life> lives_;  // one a target; the older first
  std::vector<Start> starts_;
  std::int64_t next_id_ = 1;
  FramePairStarts pairs_;
  std::vector<float> quantile_workspace_;
  std::int64_t last_frame_ = -1;
  double last_time_ = 0;
};

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "glint/engine/config.hpp"
#include "glint/engine/filters/imm.hpp"
#include "glint/engine/trackers/imm_pda_ai/amplitude.hpp"
#include "glint/engine/tracks/scan_points.hpp"
#include "glint/engine/tracks/tracker.hpp"
#include "glint/kernels/core/device.hpp"

namespace glint {

/// Settings of `imm-pda-ai`. The unit of time is the frame interval, whatever the frame rate.
struct ImmPdaAiConfig {
  // Where points come from.
  std::string points = "scan";         ///< scan, units
  std::string threshold = "mean";      ///< units: mean (20), displayed (23)
  double threshold_scale = 1.1;        ///< units: multiple of it
  double measurement_variance = 0;     ///< [px^2]; 0 = auto, 16 for units, 1 for points
  std::string amplitude = "rayleigh";  ///< rayleigh, gaussian, none
  // How a target moves.
  double noise_slow = 0.02, noise_fast = 1;  ///< [px^2/frame^3]
  double stay = 0.9;                         ///< probability of no change of model
  // Association.
  double detection = 0.9;
  double gate = 9.21;          ///< squared distance in sigmas; 9.21 holds 99 %
  double clutter_density = 0;  ///< [1/px^2]; 0 = auto, points / area of the frame or of all points
  // How tracks come and go.
  bool initiate = true;
  double start_amplitude = 5;                ///< [sigma]
  double velocity_sd = 2;                    ///< of a new target [px/frame]
  int confirm_hits = 4, confirm_window = 5;  ///< scans
  int halt_misses = 4;                       ///< scans
  double separation = 6;                     ///< [px]
};
void describe(FieldList& f, ImmPdaAiConfig& c);

/// Interacting multiple models with probabilistic data association and amplitude information, a
/// tracker of points: P-HPMHT section 4 after Lerro and Bar-Shalom 1993, started and ended by
/// itself (docs/trackers/imm-pda-ai.md). Targets are followed independently of each other.
class ImmPdaAi : public TrackerOf<ImmPdaAi> {
 public:
  /// Throws ConfigError for settings that do not fit together.
  ImmPdaAi(const ImmPdaAiConfig& config, const Device& device, std::uint64_t seed);
  Feed feed() const override { return config_.points == "units" ? Feed::frames : Feed::both; }
  /// A confirmed track that is at (x, y) [px] with velocity (vx, vy) [px/frame] at the next scan;
  /// the scans after that move it.
  void start(double x, double y, double vx, double vy) { starts_.push_back({x, y, vx, vy}); }
  void step(const Scan& scan, TrackLog& log) override;

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.starts_, s.tracks_, s.next_id_, s.last_frame_, s.last_time_, s.area_);
  }
  void restored();

 private:
  struct Start {
    double x, y, vx, vy;
    template <class Self>
    static auto fields(Self& s) {
      return std::tie(s.x, s.y, s.vx, s.vy);
    }
  };
  struct Measurement {
    Eigen::Vector2d position;
    double amplitude;  ///< [sigma]
    bool free = true;  ///< in the gate of no track
  };
  struct Track {
    std::int64_t id = 0;
    std::int64_t first_frame = 0, last_seen = 0;
    Imm imm;
    TargetAmplitude amplitude;
    Eigen::Vector2d position;  ///< [px]: asked for by every other track, so kept
    bool confirmed = false, over = false;
    int age = 1, hits = 1, misses = 0;  ///< scans
    template <class Self>
    static auto fields(Self& s) {
      return std::tie(s.id, s.first_frame, s.last_seen, s.imm, s.amplitude, s.position, s.confirmed,
                      s.over, s.age, s.hits, s.misses);
    }
  };

  void measure(const Scan& scan);
  void take_units(FrameView frame);
  void set_clutter(const Scan& scan);
  void associate(const Track& track);
  void update(Track& track, std::int64_t frame);
  void learn(Track& track, std::size_t points, std::int64_t frame) const;
  void end_duplicates();
  Imm bank_at(const Start& at) const;
  Track track_at(const Start& at, double amplitude, std::int64_t frame);
  void add_starts(const Scan& scan);
  void start_from_free_points(const Scan& scan);
  bool crowded(const Eigen::Vector2d& position) const;
  void report(const Scan& scan, double rate, TrackLog& log);

  ImmPdaAiConfig config_;
  Device device_;
  Eigen::Matrix2d noise_;
  AmplitudeModel amplitude_model_;
  double miss_;  ///< 1 - P_D P_G
  std::vector<Start> starts_;
  std::vector<Track> tracks_;  ///< by rising id
  std::int64_t next_id_ = 1, last_frame_ = -1;
  double last_time_ = 0;

  std::vector<Measurement> measurements_;
  double clutter_ = 0;  ///< [1/px^2]
  PointArea area_;
  double amplitude_threshold_ = 0;  ///< [sigma] that every measurement exceeds
  // Of the track at hand.
  std::vector<bool> gated_;
  std::vector<Eigen::Vector2d> positions_;
  std::vector<double> amplitudes_, log_ratio_;
  std::vector<double> beta_;  ///< by model: none of the points, then each
  // Memory to be used again.
  std::vector<std::uint32_t> free_;  ///< numbers of the points that may start a track
  std::vector<float> levels_;
  std::vector<Point> units_;
  PointWorkspace workspace_;
};

}  // namespace glint

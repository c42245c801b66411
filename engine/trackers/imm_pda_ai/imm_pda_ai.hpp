// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "glint/engine/config.hpp"
#include "glint/engine/filters/imm.hpp"
#include "glint/engine/trackers/imm_pda_ai/amplitude.hpp"
#include "glint/engine/tracks/point_track.hpp"
#include "glint/engine/tracks/scan_points.hpp"
#include "glint/engine/tracks/step_clock.hpp"
#include "glint/engine/tracks/track_life.hpp"
#include "glint/engine/tracks/tracker.hpp"
#include "glint/kernels/core/device.hpp"
#include "glint/kernels/find_points/find_points.hpp"

namespace glint {

/// Whose points: those of the scan, or bright 5x5 units of the frame as delivered.
enum class PointOrigin { scan, units };
/// What a unit must exceed: the frame's mean, P-HPMHT (20), or I_Th, (23).
enum class UnitThreshold { mean, displayed };

/// Settings of `imm-pda-ai`. The unit of time is the frame interval, whatever the frame rate.
struct ImmPdaAiConfig {
  // Where points come from.
  PointOrigin points = PointOrigin::scan;
  UnitThreshold threshold = UnitThreshold::mean;
  double threshold_scale = 1.1;     ///< units: multiple of it
  double measurement_variance = 0;  ///< [px^2]; 0 = auto, 16 for units, 1 for points
  AmplitudeModel amplitude = AmplitudeModel::rayleigh;
  // How a target moves.
  double noise_slow = 0.02, noise_fast = 1;  ///< [px^2/frame^3]
  double stay = 0.9;                         ///< probability of no change of model
  // Association.
  double detection = 0.9;
  double gate = 9.21;          ///< squared distance in sigmas; 9.21 holds 99 %
  double clutter_density = 0;  ///< [1/px^2]; 0 = auto, points / area of the frame or of all points
  // How tracks come and go.
  bool initiate = true;
  double start_amplitude = 5;  ///< [sigma]
  double velocity_sd = 2;      ///< of a new target [px/frame]
  HitLogic life{.confirm_hits = 4, .confirm_window = 5, .halt_misses = 4};
  double separation = 6;  ///< [px]
};
void describe(FieldList& f, ImmPdaAiConfig& c);

/// Interacting multiple models with probabilistic data association and amplitude information, a
/// tracker of points: P-HPMHT section 4 after Lerro and Bar-Shalom 1993, started and ended by
/// itself (docs/trackers/imm-pda-ai.md). Targets are followed independently of each other.
class ImmPdaAi : public TrackerOf<ImmPdaAi> {
 public:
  /// Throws ConfigError for settings that do not fit together.
  ImmPdaAi(const ImmPdaAiConfig& config, const Device& device, std::uint64_t seed);
  Feed feed() const override {
    return config_.points == PointOrigin::units ? Feed::frames : Feed::both;
  }
  /// A confirmed track that is at (x, y) [px] with velocity (vx, vy) [px/frame] at the next scan;
  /// the scans after that move it.
  void start(double x, double y, double vx, double vy) { known_.push_back({{x, vx, y, vy}}); }
  void step(const Scan& scan, TrackLog& log) override;

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.clock_, s.known_, s.tracks_, s.next_id_, s.points_.area);
  }
  void restored() const;

 private:
  struct Track : PointTrack {
    Imm imm;
    template <class Self>
    static auto fields(Self& s) {
      return std::tuple_cat(PointTrack::fields(s), std::tie(s.imm));
    }
  };

  void measure(const Scan& scan);
  void measure_units(FrameView frame);
  void set_clutter();
  void gate(const Imm& imm);
  void update(Track& track, const StepTime& at);
  void update_life(Track& track, const StepTime& at) const;
  void end_duplicates();
  Imm bank_at(const KnownTarget& target) const;
  void add(const Imm& imm, double amplitude, bool known, const StepTime& at);
  void take_cues(const Scan& scan, const StepTime& at);
  void start_known(const StepTime& at);
  void start_from_free_points(const StepTime& at);
  bool near_a_track(const Eigen::Vector2d& position) const;

  ImmPdaAiConfig config_;
  Device device_;
  Eigen::Matrix2d noise_;
  AmplitudeModel amplitude_model_;
  double miss_;  ///< 1 - P_D P_G
  StepClock clock_;
  std::vector<KnownTarget> known_;
  std::vector<Track> tracks_;  ///< by rising id
  std::int64_t next_id_ = 1;

  ScanPoints points_;
  double clutter_ = 0;              ///< [1/px^2]
  double amplitude_threshold_ = 0;  ///< [sigma] that every point exceeds
  // Of the track at hand.
  std::vector<bool> inside_;  ///< by point: in its gate
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

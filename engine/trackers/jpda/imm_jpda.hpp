// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "glint/engine/config.hpp"
#include "glint/engine/trackers/jpda/sensor_window.hpp"
#include "glint/engine/tracks/point_track.hpp"
#include "glint/engine/tracks/scan_points.hpp"
#include "glint/engine/tracks/step_clock.hpp"
#include "glint/engine/tracks/tracker.hpp"
#include "glint/engine/tracks/two_point_starts.hpp"
#include "glint/kernels/core/device.hpp"

namespace glint {

/// Settings of `imm-jpda`. Positions are in px, or whatever unit the points are in.
struct ImmJpdaConfig : PointTrackConfig, PointSensorConfig, ImmWindowConfig {
  // How a target moves.
  std::string motion = "ncv+ncv";  ///< models, "+" between
  double noise = 0.05;             ///< acceleration of ncv [px/time^2]
  double noise_agile = 0.5;        ///< of the second ncv, or jumps of that of the first wpa
  double noise_jump = 4;           ///< of the second wpa
  double stay = 0.95;              ///< probability of no change of model
  TimeUnit clock = TimeUnit::frames;
  double clutter_density = 0;               ///< of false points [1/px^2]; 0 = auto
  double position_sd = 0, velocity_sd = 1;  ///< of a known start [px], [px/time]; 0 = as a point's

  ImmJpdaConfig() {
    life.birth_existence = 0.1, life.confirm_existence = 0.9;
    life.confirm_hits = 3, life.confirm_window = 4;
  }
};
void describe(FieldList& f, ImmJpdaConfig& c);

struct ImmMscanJpdaConfig : ImmJpdaConfig {
  ImmMscanJpdaConfig() { window = 2; }
};

/// Names of the models, in order.
std::vector<std::string> imm_jpda_modes(const ImmJpdaConfig& config);
/// A bank of these models, all of them at `state`, [x vx y vy]. Accelerations are 0, with the
/// standard deviation of the model's noise.
Imm imm_jpda_bank(const ImmJpdaConfig& config, const Gaussian<4>& state);

/// Interacting multiple models with joint probabilistic data association over one scan or a window
/// of scans, a tracker of points: P-JPDA with the corrections of docs/trackers/imm-jpda.md. Starts
/// and ends its tracks by itself, unless its settings say otherwise.
class ImmJpda : public TrackerOf<ImmJpda> {
 public:
  ImmJpda(const ImmJpdaConfig& config, const Device& device, std::uint64_t seed);
  Feed feed() const override { return Feed::points; }
  /// A confirmed track that is at (x, y) [px] with velocity (vx, vy) [px/time] at the next scan;
  /// the scans after that move it.
  void start(double x, double y, double vx, double vy) { known_.push_back({{x, vx, y, vy}}); }
  void step(const Scan& scan, TrackLog& log) override;
  std::vector<std::string> notes() const override;

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.clock_, s.last_time_, s.known_, s.confirmed_, s.tentative_, s.next_id_,
                    s.scans_, s.approximate_, s.trimmed_, s.independent_, s.largest_,
                    s.points_.area, s.starts_);
  }
  void restored() const;

 private:
  /// Tracks that compete for points, by rising id, and their filters.
  struct TrackSet {
    SensorWindow window;
    std::vector<PointTrack> tracks;
    void add(PointTrack track, const Imm& bank);
    void remove(std::size_t i);
    template <class Self>
    static auto fields(Self& s) {
      return std::tie(s.window, s.tracks);
    }
  };

  void read_points(const Scan& scan);
  void associate(TrackSet& set, const StepTime& at);
  void count(const MultiscanReport& report, bool windowed);
  void update(TrackSet& set, const StepTime& at);
  void end_duplicates();
  void move_confirmed();
  void take_cues(const Scan& scan, const StepTime& at);
  void start_known(const StepTime& at);
  void start_tracks(const StepTime& at);
  void add(TrackSet& set, const Gaussian<4>& state, double amplitude, const StepTime& at);
  double rate(const StepTime& at) const;
  bool near_a_track(const Eigen::Vector2d& position) const;
  void report(TrackSet& set, const StepTime& at, TrackLog& log);

  ImmJpdaConfig config_;
  StepClock clock_;
  double last_time_ = 0, elapsed_ = 1;  // [s]; since the last scan [time]
  std::vector<KnownTarget> known_;
  TrackSet confirmed_, tentative_;
  std::int64_t next_id_ = 1;
  std::int64_t scans_ = 0, approximate_ = 0, trimmed_ = 0, independent_ = 0;
  std::size_t largest_ = 0;

  // Of the scan at hand.
  Eigen::Vector2d place_;  // of the sensor
  ScanPoints points_;
  double density_ = 0;                      // of false points [1/px^2]
  std::vector<std::uint32_t> offered_;      // numbers of the points that the set at hand may have
  std::vector<Eigen::Vector2d> positions_;  // of these
  TwoPointStarts starts_;
};

}  // namespace glint

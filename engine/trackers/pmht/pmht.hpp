// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "glint/engine/trackers/pmht/kalman_bank.hpp"
#include "glint/engine/trackers/pmht/pmht_em.hpp"
#include "glint/engine/tracks/point_track.hpp"
#include "glint/engine/tracks/scan_points.hpp"
#include "glint/engine/tracks/step_clock.hpp"
#include "glint/engine/tracks/tracker.hpp"
#include "glint/engine/tracks/two_point_starts.hpp"
#include "glint/kernels/core/device.hpp"

namespace glint {

/// Who competes for points: a model with the same model of other targets, as printed, or the models
/// of a target together with those of others.
enum class PmhtAssociation { per_model, mixture };

/// Settings of `pmht-imm`. The unit of time is that of `clock`.
struct PmhtConfig : PointTrackConfig {
  // How a target moves.
  std::string motion = "ca+singer";
  double cv_noise = 0.02;      ///< [px^2/time^3]
  double ca_noise = 0.01;      ///< [px^2/time^4]
  double singer_fading = 0.2;  ///< [1/time]
  double singer_variance = 2;  ///< [px^2/time^4]
  double noise_ratio = 100;    ///< second to first of two alike models
  double stay = 0.999;         ///< probability of no change of model
  TimeUnit clock = TimeUnit::frames;
  // Which points are whose.
  double measurement_variance = 9;  ///< [px^2]
  double gate = 14;                 ///< half side of the square [px]
  double detection = 0.95;
  double clutter_density = 0;  ///< [1/px^2]; 0 = auto
  PmhtAssociation association = PmhtAssociation::per_model;
  int iterations = 50;
  double tolerance = 1e-3;  ///< [px]

  PmhtConfig() { speed_max = 20; }
};
void describe(FieldList& f, PmhtConfig& c);

/// One model, and no interaction: P-PMHT's CA-PMHT and SMM-PMHT.
struct PmhtCaConfig : PmhtConfig {
  PmhtCaConfig() { motion = "ca"; }
};
struct PmhtSingerConfig : PmhtConfig {
  PmhtSingerConfig() { motion = "singer"; }
};
/// The same model twice, with little and with much process noise: homothetic PMHT.
struct PmhtHomotheticConfig : PmhtConfig {
  PmhtHomotheticConfig() { motion = "ca+ca"; }
};

/// The two points that a track starts from: a position, and a velocity that is known as well as
/// two points one `step` apart tell it.
struct PmhtStart {
  Eigen::Vector2d position, velocity;  ///< [px], [px/time]
  double step = 1;                     ///< [time]
  /// Variances that are told instead [px^2], [px^2/time^2]; 0: those of two such points.
  double position_variance = 0, velocity_variance = 0;

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.position, s.velocity, s.step, s.position_variance, s.velocity_variance);
  }
};

/// The motion models of a tracker of points, their names and their start.
std::vector<std::string> pmht_mode_names(const PmhtConfig& config);
Imm pmht_bank(const PmhtConfig& config, const PmhtStart& start);

/// Where a track was expected before its scan.
struct ExpectedPlace {
  std::int64_t track_id;
  double x, y;  ///< [px]

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.track_id, s.x, s.y);
  }
};

/// Sequential PMHT over all targets and motion models on each scan, a tracker of points: P-PMHT
/// with the corrections of docs/trackers/pmht-imm.md. Starts and ends its tracks by itself unless
/// told otherwise. `Bank` is what a target is followed with.
template <class Config, class Bank>
class PmhtTracker : public TrackerOf<PmhtTracker<Config, Bank>> {
 public:
  PmhtTracker(const Config& config, const Device& device, std::uint64_t seed);
  Feed feed() const override { return Feed::points; }
  /// A confirmed track that is at (x, y) [px] with velocity (vx, vy) [px/time] at the next scan;
  /// the scans after that move it. P-PMHT takes both from two points.
  void start(double x, double y, double vx, double vy) { known_.push_back({{x, y}, {vx, vy}, 1}); }
  void step(const Scan& scan, TrackLog& log) override;
  /// Of the tracks that the last scan moved, by rising id.
  const std::vector<ExpectedPlace>& expected() const { return expected_; }

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.clock_, s.last_time_, s.known_, s.tracks_, s.next_id_, s.expected_,
                    s.points_.area, s.starts_);
  }
  void restored() const;

 private:
  struct Track : PointTrack {
    Bank bank;
    double weight = 0, ratio = 1;  // number of its points in this scan; what they say of existence
    template <class Self>
    static auto fields(Self& s) {
      return std::tuple_cat(PointTrack::fields(s), std::tie(s.bank));
    }
  };

  void take_points(const Scan& scan);
  void take_cues(const Scan& scan, const StepTime& at);
  double rate(const StepTime& at) const;
  void predict();
  void associate(bool confirmed, const StepTime& at);
  void gate(bool confirmed);
  void take_in(const StepTime& at);
  void end_duplicates();
  void add(const PmhtStart& start, double amplitude, bool known, const StepTime& at);
  void start_tracks(const StepTime& at);
  bool crowded(const Eigen::Vector2d& position) const;
  void report(const StepTime& at, TrackLog& log);

  Config config_;
  std::uint64_t seed_;
  PmhtSettings settings_;
  StepClock clock_;
  double last_time_ = 0, elapsed_ = 1;  // [s]; since the last scan [time]
  std::vector<PmhtStart> known_;
  std::vector<Track> tracks_;  // by rising id
  std::int64_t next_id_ = 1;
  std::vector<ExpectedPlace> expected_;

  // Of the scan at hand.
  ScanPoints points_;
  TwoPointStarts starts_;
  // Of the tracks that compete for its points.
  std::vector<Track*> followers_;
  std::vector<PmhtMode> modes_;
  std::vector<PmhtPair> pairs_;
  PmhtEm em_;
};

extern template class PmhtTracker<PmhtConfig, KalmanBank>;
using Pmht = PmhtTracker<PmhtConfig, KalmanBank>;

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <tuple>

#include "glint/engine/config.hpp"
#include "glint/engine/tracks/track_log.hpp"

namespace glint {

/// M-of-N logic: a track is confirmed, or ends, by how often it is seen.
struct HitLogic {
  int confirm_hits = 4, confirm_window = 6;  ///< scans, those of the first points included
  int halt_misses = 5;                       ///< scans in a row; 0 = never
};
/// Throws ConfigError if no track could be confirmed.
void check(const HitLogic& logic);

/// The same, and by the probability that the target exists.
struct TrackLifeConfig : HitLogic {
  double survival = 0.99;         ///< probability that a target lasts from scan to scan
  double birth_existence = 0.05;  ///< that the first two points of a track are a target
  double confirm_existence = 0.95;
  double halt_existence = 1e-4;  ///< 0 = never
};
void describe(FieldList& f, TrackLifeConfig& c);

/// Whether a target is there, by M of N and by the probability of existence (Musicki, Evans and
/// Stankovic 1994), or by M of N alone.
class TrackLife {
 public:
  /// To be restored.
  TrackLife() = default;
  /// A tentative track after its first two points, or one that is known to be a target.
  TrackLife(const TrackLifeConfig& config, bool known);
  /// A further scan. `hit`: it holds a point of the target; `ratio`: likelihood of its points if
  /// the target is there over that if it is not; `step`: scans since the last one.
  void see(const TrackLifeConfig& config, bool hit, double ratio, double step);

  /// By M of N alone: a track after its first point. The probability of existence is not known.
  TrackLife(const HitLogic& logic, bool known);
  void see(const HitLogic& logic, bool hit);
  void end() { over_ = true; }

  bool confirmed() const { return confirmed_; }
  bool over() const { return over_; }
  /// NaN if not known.
  double existence() const { return existence_; }
  TrackStatus status() const;

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.existence_, s.confirmed_, s.over_, s.age_, s.hits_, s.misses_);
  }

 private:
  void judge(const HitLogic& logic, bool hit, bool sure, bool unlikely);

  double existence_ = 0;
  bool confirmed_ = false, over_ = false;
  int age_ = 2, hits_ = 2, misses_ = 0;  // scans
};

}  // namespace glint

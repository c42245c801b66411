// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "glint/engine/metrics/metrics.hpp"
#include "glint/engine/scenario/truth.hpp"
#include "glint/engine/tracks/track_log.hpp"

namespace glint {

inline constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

struct EvaluationOptions {
  double cutoff = 5;               ///< [px]
  double order = 2;                ///< of OSPA and GOSPA
  bool include_tentative = false;  ///< see is_scored()
  /// Scored are frames 0 to frames - 1; without it, up to the last frame that is mentioned.
  std::optional<std::int64_t> frames;
};

/// Whether a point claims a target: a confirmed one does, and, if asked for, a tentative one that
/// does not state an existence below 1/2.
bool is_scored(const TrackPoint& point, bool include_tentative);

/// What became of one truth. NaN where undefined.
struct TruthScore {
  std::int64_t first = 0, last = 0;  ///< frames
  double rmse = kUndefined;          ///< [px] of the matched points
  /// Frames from birth to the first matched point; NaN if there is none.
  double detect_delay = kUndefined;
  /// Frames from the last truth to the end of the last track that counts for it, negative if that
  /// stopped early; NaN without such a track, or if the truth lasts to the end of the sequence.
  double halt_delay = kUndefined;
  int identities = 0;     ///< different tracks among the matched points
  bool detected = false;  ///< some track counts for it
};

/// How well tracks follow truths. Matched = assigned within the cut-off at a frame. A track counts
/// for the truth that is within the cut-off of most of its points, if these are at least half.
/// Scored are the points that is_scored() names, never halted ones.
struct Evaluation {
  std::vector<Ospa> ospa;    ///< one a frame
  std::vector<Gospa> gospa;  ///< one a frame
  Ospa mean_ospa;            ///< over frames, of distance and of each part
  Gospa mean_gospa;
  double mean_cardinality_error = 0;  ///< estimates - truths, over frames
  std::map<std::int64_t, TruthScore> truths;
  std::map<std::int64_t, std::optional<std::int64_t>> counts_for;  ///< by track: a truth, or none
  int tracks = 0, false_tracks = 0;
  int detected_truths = 0;
  double track_detection_probability = kUndefined;  ///< detected truths / truths
  double identities_per_truth = kUndefined;         ///< over truths matched at least once
  double detected_points = kUndefined;              ///< matched truth points / truth points
  double false_points_per_frame = kUndefined;       ///< points that are not matched
};
Evaluation evaluate(std::span<const TruthPoint> truth, std::span<const TrackPoint> tracks,
                    const EvaluationOptions& options = {});

/// A point of a single-frame detector.
struct Detection {
  std::int64_t frame = 0;
  double x = 0, y = 0;   ///< [px]
  double amplitude = 0;  ///< what the detector puts a threshold on
};

/// What a single-frame detector attains at its best fair threshold.
struct Baseline {
  double threshold = kUndefined;  ///< lowest amplitude kept; NaN if there are no detections
  double detected_points = kUndefined;
  double false_points_per_frame = kUndefined;
};
/// The matched-filter baseline, fair at equal false points: the lowest threshold whose false points
/// per frame do not exceed `false_points_per_frame`.
Baseline detector_baseline(std::span<const TruthPoint> truth, std::span<const Detection> detections,
                           double false_points_per_frame, const EvaluationOptions& options = {});

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/metrics/evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "glint/engine/metrics/by_frame.hpp"

namespace glint {
namespace {

/// What is known of a track: its points, and how many of them lie near each truth.
struct TrackTally {
  int points = 0;
  std::int64_t last = 0;
  std::map<std::int64_t, int> near;
};

struct TruthTally {
  int matched = 0;
  double squared = 0;
  std::map<std::int64_t, int> identities;
};

struct Tally {
  std::map<std::int64_t, TrackTally> tracks;
  std::map<std::int64_t, TruthTally> truths;
  std::int64_t truth_points = 0, matched = 0, false_points = 0, miscounted = 0;
};

std::vector<TrackPoint> scored_points(std::span<const TrackPoint> tracks, bool tentative) {
  std::vector<TrackPoint> scored;
  std::ranges::copy_if(tracks, std::back_inserter(scored),
                       [&](const TrackPoint& point) { return is_scored(point, tentative); });
  return scored;
}

void note_truths(const std::vector<TruthPoint>& truth, Evaluation& result) {
  for (const TruthPoint& point : truth) {
    const auto [at, is_new] = result.truths.try_emplace(point.track_id);
    if (is_new) at->second.first = point.frame;
    at->second.last = point.frame;
  }
}

void note_tracks(const std::vector<TruthPoint>& truth, const std::vector<TrackPoint>& tracks,
                 double cutoff, Tally& tally) {
  for (const TrackPoint& point : tracks) {
    TrackTally& track = tally.tracks[point.track_id];
    ++track.points;
    track.last = point.frame;
    for (const TruthPoint& t : truth) {
      if (std::hypot(point.x - t.x, point.y - t.y) <= cutoff) ++track.near[t.track_id];
    }
  }
}

void note_matches(const std::vector<TruthPoint>& truth, const std::vector<TrackPoint>& tracks,
                  const std::vector<Match>& matches, Tally& tally, Evaluation& result) {
  for (const Match& match : matches) {
    const TruthPoint& point = truth[static_cast<std::size_t>(match.truth)];
    TruthTally& of = tally.truths[point.track_id];
    TruthScore& score = result.truths.at(point.track_id);
    if (of.matched == 0) score.detect_delay = static_cast<double>(point.frame - score.first);
    ++of.matched;
    of.squared += match.distance * match.distance;
    ++of.identities[tracks[static_cast<std::size_t>(match.estimate)].track_id];
  }
  tally.truth_points += static_cast<std::int64_t>(truth.size());
  tally.matched += static_cast<std::int64_t>(matches.size());
  tally.false_points += static_cast<std::int64_t>(tracks.size() - matches.size());
  tally.miscounted += std::abs(std::ssize(tracks) - std::ssize(truth));
}

void score_truths(const Tally& tally, Evaluation& result) {
  int seen = 0, identities = 0;
  for (const auto& [id, truth] : tally.truths) {
    TruthScore& score = result.truths.at(id);
    score.rmse = std::sqrt(truth.squared / truth.matched);
    score.identities = static_cast<int>(truth.identities.size());
    identities += score.identities;
    ++seen;
  }
  if (seen > 0) result.identities_per_truth = static_cast<double>(identities) / seen;
}

void score_tracks(const Tally& tally, std::int64_t frames, Evaluation& result) {
  result.tracks = static_cast<int>(tally.tracks.size());
  for (const auto& [id, track] : tally.tracks) {
    const auto best =
        std::max_element(track.near.begin(), track.near.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    auto& counts_for = result.counts_for[id];
    if (best == track.near.end() || 2 * best->second < track.points) {
      ++result.false_tracks;
      continue;
    }
    counts_for = best->first;
    TruthScore& truth = result.truths.at(best->first);
    truth.detected = true;
    if (truth.last == frames - 1) continue;
    const auto delay = static_cast<double>(track.last - truth.last);
    truth.halt_delay = std::isnan(truth.halt_delay) ? delay : std::max(truth.halt_delay, delay);
  }
  for (const auto& [id, truth] : result.truths) result.detected_truths += truth.detected ? 1 : 0;
  if (!result.truths.empty()) {
    result.track_detection_probability =
        static_cast<double>(result.detected_truths) / static_cast<double>(result.truths.size());
  }
}

void average(const Tally& tally, std::int64_t frames, Evaluation& result) {
  const auto n = static_cast<double>(frames);
  for (std::size_t k = 0; k < result.ospa.size(); ++k) {
    result.mean_ospa.distance += result.ospa[k].distance / n;
    result.mean_ospa.localisation += result.ospa[k].localisation / n;
    result.mean_ospa.cardinality += result.ospa[k].cardinality / n;
    result.mean_gospa.distance += result.gospa[k].distance / n;
    result.mean_gospa.localisation += result.gospa[k].localisation / n;
    result.mean_gospa.missed += result.gospa[k].missed / n;
    result.mean_gospa.false_alarms += result.gospa[k].false_alarms / n;
  }
  if (tally.truth_points > 0) {
    result.detected_points =
        static_cast<double>(tally.matched) / static_cast<double>(tally.truth_points);
  }
  if (frames == 0) return;
  result.mean_cardinality_error = static_cast<double>(tally.miscounted) / n;
  result.false_points_per_frame = static_cast<double>(tally.false_points) / n;
}

}  // namespace

bool is_scored(const TrackPoint& point, bool include_tentative) {
  if (point.status == TrackStatus::tentative) return include_tentative && !(point.existence < 0.5);
  return point.status == TrackStatus::confirmed;
}

Evaluation evaluate(std::span<const TruthPoint> truth, std::span<const TrackPoint> tracks,
                    const EvaluationOptions& options) {
  const std::vector<TrackPoint> scored = scored_points(tracks, options.include_tentative);
  const std::int64_t frames =
      options.frames.value_or(std::max(frame_count(truth), frame_count(tracks)));
  const auto truth_by_frame = by_frame(truth, frames);
  const auto tracks_by_frame = by_frame(std::span<const TrackPoint>(scored), frames);
  Evaluation result;
  Tally tally;
  for (std::size_t k = 0; k < truth_by_frame.size(); ++k) {
    const std::vector<Position> there = positions(truth_by_frame[k]);
    const std::vector<Position> reported = positions(tracks_by_frame[k]);
    result.ospa.push_back(ospa(there, reported, options.cutoff, options.order));
    result.gospa.push_back(gospa(there, reported, options.cutoff, options.order));
    note_truths(truth_by_frame[k], result);
    note_tracks(truth_by_frame[k], tracks_by_frame[k], options.cutoff, tally);
    note_matches(truth_by_frame[k], tracks_by_frame[k],
                 match(there, reported, options.cutoff, options.order), tally, result);
  }
  score_truths(tally, result);
  score_tracks(tally, frames, result);
  average(tally, frames, result);
  return result;
}

}  // namespace glint

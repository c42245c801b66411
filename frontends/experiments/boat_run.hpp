// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <limits>
#include <map>

#include "glint/engine/trackers/jpda/imm_jpda.hpp"
#include "glint/experiments/evaluation_bytes.hpp"
#include "glint/frontends/files/autoferry.hpp"

namespace glint {

/// What is done to a recording before it is tracked.
struct BoatTrial {
  double reach = std::numeric_limits<double>::infinity();  ///< [m] from the ship; beyond is nothing
  double keep = 1;                                         ///< share of the points that stay
  double clutter = 0;  ///< density of false points [1/m^2], uniform over the truths and 60 m about
  std::uint64_t seed = 1;
};
BoatRecord changed(const BoatRecord& record, const BoatTrial& trial);

/// Share of a boat's scans with a track on it, in the record as revised.
struct Coverage {
  double any = 0, one = 0;  ///< any tracks; the best single one
};

/// How a tracker followed the boats; OSPA and matches at a cut-off of 20 m, order 2.
struct BoatScore {
  Evaluation scores;
  std::map<std::int64_t, Coverage> coverage;  ///< by boat
  // Of tracks started from the truth.
  int lost = 0;     ///< boats whose own track is more than 20 m off at the end, or has ended
  int swapped = 0;  ///< boats whose own track is with the other one at the end
  /// Scan, from 1, when a track that counts for the boat is first confirmed; by boat, none if
  /// never.
  std::map<std::int64_t, double> confirmed;
};
auto fields(OneOf<BoatScore> auto& s) {
  return std::tie(s.scores, s.coverage, s.lost, s.swapped, s.confirmed);
}

/// The first scan, from 1, by which a boat has given `hits` echoes within `window` scans, the first
/// two of them in a row: sooner no track that starts on two points can be confirmed. An echo is a
/// point within `reach` [m] of the truth. NaN if it never has.
double confirmable_at(const BoatRecord& record, std::int64_t boat, const HitLogic& logic,
                      double reach);

/// Steps the tracker over the scans. Unless the tracker initiates by itself, every boat is started
/// where it is when it comes within reach. Tracks beyond `reach` [m] of the ship do not count.
BoatScore follow_boats(const BoatRecord& record, const ImmJpdaConfig& config, double reach);

}  // namespace glint

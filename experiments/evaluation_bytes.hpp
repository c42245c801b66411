// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <tuple>

#include "glint/engine/metrics/evaluation.hpp"
#include "glint/experiments/run_bytes.hpp"

namespace glint {

auto fields(OneOf<Evaluation> auto& e) {
  return std::tie(e.ospa, e.gospa, e.mean_ospa, e.mean_gospa, e.mean_cardinality_error, e.truths,
                  e.counts_for, e.tracks, e.false_tracks, e.detected_truths,
                  e.track_detection_probability, e.identities_per_truth, e.detected_points,
                  e.false_points_per_frame);
}

}  // namespace glint

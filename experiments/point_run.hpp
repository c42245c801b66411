// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "glint/engine/scenario/point_sensor.hpp"
#include "glint/engine/trackers/pmht/mmpf_pmht.hpp"
#include "glint/experiments/experiment.hpp"
#include "glint/experiments/run_bytes.hpp"

namespace glint {

/// How a tracker followed a target that it was started on.
struct FollowedTarget {
  double prediction_error = 0;  ///< mean distance of where it was expected [px]
  double estimation_error = 0;  ///< of where it was found [px]
  bool lost = false;  ///< expected more than 14 px away three frames in a row, or at the end
  std::vector<double> normalised;  ///< errors of x and y over their standard deviations, by frame
};
auto fields(OneOf<FollowedTarget> auto& t) {
  return std::tie(t.prediction_error, t.estimation_error, t.lost, t.normalised);
}

using FollowedRun = std::vector<FollowedTarget>;  ///< by target

/// A tracker's run over a scene seen as points, started on every target's first two points; scored
/// from the third frame on, while each target is there. P-PMHT section 4.
FollowedRun follow_points(const Scene& scene, const PointSensor& sensor, const PmhtConfig& config,
                          std::uint64_t seed);

FollowedRun follow_points(const Scene& scene, const PointSensor& sensor,
                          const MmpfPmhtConfig& config, std::uint64_t seed);

/// The settings of the papers: tracks start where they are told, and never end.
void start_on_targets(PmhtConfig& config, double clutter_density);

/// Prediction errors of a target by run, NaN where it was lost.
std::vector<double> prediction_errors(const std::vector<FollowedRun>& runs, std::size_t target);
std::vector<double> estimation_errors(const std::vector<FollowedRun>& runs, std::size_t target);
/// Share of the targets that are lost, by run [%].
std::vector<double> lost_shares(const std::vector<FollowedRun>& runs);

}  // namespace glint

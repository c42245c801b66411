// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <string>

#include "glint/engine/scenario/scenes.hpp"
#include "glint/experiments/monte_carlo.hpp"
#include "glint/experiments/pmht.hpp"
#include "glint/experiments/point_run.hpp"

namespace glint {
namespace {

struct Case {
  const char* name;
  double percent;    // clutter
  double most_lost;  // 1.3 and 1.5, and two standard errors of the mean of 200 clips
};

/// Each run has paths of its own.
FollowedRun follow(const Case& c, std::uint64_t seed) {
  PmhtClipScene config;
  config.clip = "crowd", config.variant = static_cast<int>(seed);
  const Scene scene = make_scene(config);
  PointSensor sensor;
  sensor.clutter = PointSensor::clutter_of(scene, c.percent);
  PmhtConfig tracker;
  start_on_targets(tracker, sensor.clutter_density(scene));
  return follow_points(scene, sensor, tracker, seed);
}

std::vector<double> mean_errors(const std::vector<FollowedRun>& runs) {
  std::vector<double> means;
  for (const FollowedRun& run : runs) {
    std::vector<double> errors;
    for (const FollowedTarget& target : run) {
      if (!target.lost) errors.push_back(target.prediction_error);
    }
    means.push_back(summarise(errors).mean);
  }
  return means;
}

}  // namespace

ExperimentResult run_pmht_40_targets(const ExperimentOptions& options, Workers& workers) {
  constexpr std::array kCases{Case{"no clutter", 0, 1.52}, Case{".02 % clutter", 0.02, 1.74}};
  const auto runs =
      run_cases(kCases.size(), options, workers, [&](std::size_t which, std::size_t run) {
        return follow(kCases[which], options.seed + run);
      });
  ExperimentResult result;
  for (std::size_t i = 0; i < kCases.size(); ++i) {
    std::vector<double> lost = lost_shares(runs[i]);
    for (double& share : lost) share *= 40.0 / 100;
    const Band band{{}, kCases[i].most_lost};
    result.rows.push_back(value_row(kCases[i].name, "targets lost of 40", lost, band));
    result.rows.push_back(value_row(kCases[i].name, "prediction [px]", mean_errors(runs[i])));
  }
  return result;
}

}  // namespace glint

// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <string>

#include "glint/engine/scenario/scenes.hpp"
#include "glint/experiments/monte_carlo.hpp"
#include "glint/experiments/pmht.hpp"
#include "glint/experiments/point_run.hpp"

namespace glint {
namespace {

/// The paper's observation noise of variance 2 and process noise of .2 about noiseless paths.
PointSensor sensor() {
  PointSensor sensor;
  sensor.variance = 2.2;
  return sensor;
}

Scene scene() {
  PmhtClipScene config;
  config.clip = "monte-carlo";
  return make_scene(config);
}

void add_errors(const std::vector<FollowedRun>& runs, ExperimentResult& result) {
  struct Path {
    const char* name;
    double attained;  // [px]
  };
  constexpr std::array<Path, 3> kPaths{
      {{"constant acceleration", 2.28}, {"constant velocity", 2.05}, {"turns", 4.02}}};
  for (std::size_t t = 0; t < kPaths.size(); ++t) {
    // 2.5 standard errors of a difference of two means of 50 runs.
    const Band band{kPaths[t].attained - 0.15, kPaths[t].attained + 0.15};
    result.rows.push_back(
        value_row(kPaths[t].name, "prediction [px]", prediction_errors(runs, t), band));
    result.rows.push_back(value_row(kPaths[t].name, "estimate [px]", estimation_errors(runs, t)));
  }
  result.rows.push_back(value_row("all", "targets lost [%]", lost_shares(runs), Band{{}, 1}));
}

/// P-PMHT (35): errors over the standard deviations that the filter claims are N(0, 1).
void add_normalised(const std::vector<FollowedRun>& runs, ExperimentResult& result) {
  std::vector<double> mean, deviation;
  for (const FollowedRun& run : runs) {
    std::vector<double> errors;
    for (const FollowedTarget& target : run) {
      errors.insert(errors.end(), target.normalised.begin(), target.normalised.end());
    }
    const Summary summary = summarise(errors);
    mean.push_back(summary.mean), deviation.push_back(summary.spread);
  }
  const char* name = "R = 2.25";
  result.rows.push_back(value_row(name, "normalised error, mean", mean, Band{-0.15, 0.15}));
  result.rows.push_back(value_row(name, "normalised error, sd", deviation, Band{0.85, 1.05}));
}

}  // namespace

ExperimentResult run_pmht_monte_carlo(const ExperimentOptions& options, Workers& workers) {
  std::array<PmhtConfig, 2> configs;
  for (PmhtConfig& config : configs) start_on_targets(config, 0);
  configs[1].measurement_variance = 2.25;
  const auto runs =
      run_cases(configs.size(), options, workers, [&](std::size_t which, std::size_t run) {
        return follow_points(scene(), sensor(), configs[which], options.seed + run);
      });
  ExperimentResult result;
  add_errors(runs[0], result);
  add_normalised(runs[1], result);
  return result;
}

}  // namespace glint
